#include "server/publish/frame_builder.h"

#include <chrono>
#include <cstring>
#include <utility>

#include "server/solver/parallel.h"

namespace headrace::publish {

namespace {

// Row id of the column takes slot i's value; each row is written by one iteration, so the loop is free to be parallel.
template <class Value, class Source>
void scatter(const solver::Particles& particles, std::byte* out, int components, int component, const Source& source) {
    const auto count = static_cast<std::ptrdiff_t>(particles.size());
#pragma omp parallel for schedule(static) num_threads(solver::team_size())
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const auto value = static_cast<Value>(source[static_cast<std::size_t>(i)]);
        const auto row =
            static_cast<std::ptrdiff_t>(particles.id[static_cast<std::size_t>(i)]) * components + component;
        std::memcpy(out + row * static_cast<std::ptrdiff_t>(sizeof(Value)), &value, sizeof value);
    }
}

const solver::VectorField& vector_source(const solver::Particles& particles, proto::Field field) {
    switch (field) {
        case proto::Field::velocity:
            return particles.v;
        case proto::Field::acceleration:
            return particles.a;
        default:
            return particles.x;
    }
}

template <class Real>
Column copy_reals(const solver::Particles& particles, const proto::FieldInfo& info, std::string_view dtype) {
    const int components = info.is_vector ? particles.dimensions : 1;
    Column column{info.field, dtype, components, particles.size() * sizeof(Real) * static_cast<std::size_t>(components),
                  nullptr};
    column.bytes = std::make_unique_for_overwrite<std::byte[]>(column.size);
    if (info.is_vector) {
        const solver::VectorField& source = vector_source(particles, info.field);
        for (int k = 0; k < components; ++k) scatter<Real>(particles, column.bytes.get(), components, k, source[k]);
    } else {
        const auto& source = info.field == proto::Field::density ? particles.rho : particles.p;
        scatter<Real>(particles, column.bytes.get(), 1, 0, source);
    }
    return column;
}

Column copy_ids(const solver::Particles& particles) {
    Column column{proto::Field::id, "<u4", 1, particles.size() * sizeof(solver::Index), nullptr};
    column.bytes = std::make_unique_for_overwrite<std::byte[]>(column.size);
    scatter<solver::Index>(particles, column.bytes.get(), 1, 0, particles.id);
    return column;
}

}  // namespace

std::shared_ptr<const Capture> copy_fields(const solver::Particles& particles, proto::FieldSet fields,
                                           proto::Precision precision, const Moment& now, std::uint64_t generation) {
    using namespace std::chrono;
    auto capture = std::make_shared<Capture>();
    capture->generation = generation;
    capture->step = now.step;
    capture->time = now.time;
    capture->wall_clock = duration<double>(system_clock::now().time_since_epoch()).count();
    capture->dimensions = particles.dimensions;
    capture->particles = particles.size();
    for (const proto::FieldInfo& info : proto::kFields) {
        if (!fields.contains(info.field)) continue;
        if (info.is_integer)
            capture->columns.push_back(copy_ids(particles));
        else if (precision == proto::Precision::f8)
            capture->columns.push_back(copy_reals<double>(particles, info, "<f8"));
        else
            capture->columns.push_back(copy_reals<float>(particles, info, "<f4"));
    }
    return capture;
}

}  // namespace headrace::publish
