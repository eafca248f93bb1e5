#include "client/writers/object_mesh.h"

#include <cmath>
#include <numbers>

#include "client/writers/boxes.h"

namespace headrace::client {

namespace {

using proto::BoxDesc;
using proto::SphereDesc;
using proto::Vec3;

constexpr int kMeridians = 48;  // smooth at the size of a picture; 48 x 24 facets
constexpr int kParallels = 24;

class MeshBuilder {
  public:
    void box(const BoxDesc& box) {
        const std::int32_t first = point_count();
        for (int corner = 0; corner < 8; ++corner) point(box_corner(box, corner));
        constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
        for (const auto& face : kFaces) polygon({first + face[0], first + face[1], first + face[2], first + face[3]});
    }

    void sphere(const SphereDesc& sphere) {
        const std::int32_t first = point_count();
        for (int ring = 0; ring <= kParallels; ++ring) {
            const double polar = std::numbers::pi * ring / kParallels;  // from +y
            for (int k = 0; k < kMeridians; ++k) {
                const double azimuth = 2 * std::numbers::pi * k / kMeridians;
                point({sphere.center[0] + sphere.radius * std::sin(polar) * std::cos(azimuth),
                       sphere.center[1] + sphere.radius * std::cos(polar),
                       sphere.center[2] + sphere.radius * std::sin(polar) * std::sin(azimuth)});
            }
        }
        for (int ring = 0; ring < kParallels; ++ring)
            for (int k = 0; k < kMeridians; ++k) {
                const std::int32_t here = first + ring * kMeridians, next = here + kMeridians;
                const int k1 = (k + 1) % kMeridians;
                polygon({here + k, here + k1, next + k1, next + k});
            }
    }

    // The mantle as quadrilaterals, each end as triangles about its centre.
    void cylinder(const proto::CylinderDesc& cylinder) {
        const Vec3 axis = normalized(cylinder.to - cylinder.from);
        const std::int32_t first = point_count();
        for (const Vec3& center : {cylinder.from, cylinder.to})
            for (const Vec3& x : circle(center, cylinder.radius, axis, kMeridians)) point(x);
        const std::int32_t centers = point_count();
        point(cylinder.from);
        point(cylinder.to);
        for (int k = 0; k < kMeridians; ++k) {
            const std::int32_t a = first + k, b = first + (k + 1) % kMeridians;
            polygon({a, b, b + kMeridians, a + kMeridians});
            polygon({centers, b, a});
            polygon({centers + 1, a + kMeridians, b + kMeridians});
        }
    }

    void rectangle(const BoxDesc& box) {
        outline({{box.min[0], box.min[1], 0},
                 {box.max[0], box.min[1], 0},
                 {box.max[0], box.max[1], 0},
                 {box.min[0], box.max[1], 0}});
    }

    void disc(const SphereDesc& disc) {
        outline(circle({disc.center[0], disc.center[1], 0}, disc.radius, {0, 0, 1}, 128));
    }

    // Of the points from here on.
    void set_place(const scene::Placement& place) { place_ = place; }

    std::size_t cell_count() const { return piece_.lines.offsets.size() + piece_.polys.offsets.size(); }

    VtpPiece finish() {
        piece_.point_count = coordinates_.size() / 3;
        piece_.points = make_vtp_array("Points", coordinates_, 3);
        return std::move(piece_);
    }

  private:
    std::int32_t point_count() const { return static_cast<std::int32_t>(coordinates_.size() / 3); }
    void point(const Vec3& at_start) {
        const Vec3 x = place_(at_start);
        coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    }

    static void close_cell(VtpCells& cells) {
        cells.offsets.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
    }

    void polygon(std::initializer_list<std::int32_t> corners) {
        piece_.polys.connectivity.insert(piece_.polys.connectivity.end(), corners);
        close_cell(piece_.polys);
    }

    void outline(const std::vector<Vec3>& corners) {
        const std::int32_t first = point_count();
        for (const Vec3& corner : corners) {
            piece_.lines.connectivity.push_back(point_count());
            point(corner);
        }
        piece_.lines.connectivity.push_back(first);
        close_cell(piece_.lines);
    }

    VtpPiece piece_;
    std::vector<double> coordinates_;
    scene::Placement place_;
};

}  // namespace

VtpPiece make_object_mesh(const std::vector<PlacedObject>& objects, int dimensions) {
    MeshBuilder mesh;
    std::vector<std::int32_t> object_of_cell, is_container;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < objects.size(); ++k) {
        const proto::ObjectDesc& object = objects[k].desc;
        mesh.set_place(objects[k].place);
        if (const auto* box = std::get_if<BoxDesc>(&object.shape))
            dimensions == 2 ? mesh.rectangle(*box) : mesh.box(*box);
        else if (const auto* sphere = std::get_if<SphereDesc>(&object.shape))
            dimensions == 2 ? mesh.disc(*sphere) : mesh.sphere(*sphere);
        else if (const auto* cylinder = std::get_if<proto::CylinderDesc>(&object.shape))
            mesh.cylinder(*cylinder);
        object_of_cell.resize(mesh.cell_count(), static_cast<std::int32_t>(k));
        is_container.resize(mesh.cell_count(), object.role == proto::ObjectRole::container ? 1 : 0);
        names.push_back(object.name);
    }
    VtpPiece piece = mesh.finish();
    piece.cell_data = {make_vtp_array("object", object_of_cell), make_vtp_array("is_container", is_container)};
    piece.names = std::move(names);
    return piece;
}

}  // namespace headrace::client
