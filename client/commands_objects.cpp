// objects, remove, add, move
#include "client/arguments.h"
#include "client/command.h"
#include "client/json_words.h"
#include "client/text.h"

namespace headrace::client {

namespace {

// "removed before step 1,234"
auto print_applied(const std::string& what) {
    return [what](const proto::Applied& applied) {
        print_line(what + " before step " + with_thousands(static_cast<std::int64_t>(applied.step)));
    };
}

struct AddOptions {
    std::string name, box, sphere, cylinder, plane, shape, motion, surface_velocity, slip;
    std::string role{"obstacle"};
};

// The shape, by whichever option gave it; as JSON, so that the server says what it thinks of one from a file.
proto::Result<proto::Json> shape_of(const AddOptions& options) {
    const std::string* given = nullptr;
    for (const std::string* word : {&options.box, &options.sphere, &options.cylinder, &options.plane, &options.shape}) {
        if (word->empty()) continue;
        if (given != nullptr)
            return usage_error("an object has one shape", "--box", "add further shapes as objects of their own");
        given = word;
    }
    if (given == nullptr)
        return usage_error("an object needs a shape", "--box", "give --box, --sphere, --cylinder, --plane or --shape");
    if (given == &options.shape) return json_word(options.shape, "--shape");
    const auto as_json = [](const auto& shape) -> proto::Result<proto::Json> {
        if (!shape) return shape.error();
        proto::ObjectDesc object;
        object.shape = *shape;
        return proto::to_json(object)["shape"];
    };
    if (given == &options.box) return as_json(parse_box(options.box));
    if (given == &options.sphere) return as_json(parse_sphere(options.sphere));
    if (given == &options.cylinder) return as_json(parse_cylinder(options.cylinder));
    return as_json(parse_plane(options.plane));
}

// "0.5,0", or JSON with expressions.
proto::Result<proto::Json> surface_velocity_of(const std::string& word) {
    if (const auto numbers = parse_vector(word, "--surface-velocity")) return proto::Json(*numbers);
    return json_word(word, "--surface-velocity");
}

proto::Status add(const Globals& globals, const AddOptions& options) {
    proto::Json object{{"name", options.name}, {"role", options.role}};
    auto shape = shape_of(options);
    if (!shape) return shape.error();
    object["shape"] = *std::move(shape);
    if (!options.slip.empty()) object["slip"] = options.slip;
    if (!options.motion.empty()) {
        auto motion = json_word(options.motion, "--motion");
        if (!motion) return motion.error();
        object["motion"] = *std::move(motion);
    }
    if (!options.surface_velocity.empty()) {
        auto velocity = surface_velocity_of(options.surface_velocity);
        if (!velocity) return velocity.error();
        object["surface_velocity"] = *std::move(velocity);
    }
    auto connection = connect(globals);
    if (!connection) return connection.error();
    return request_and_print<proto::Applied>(globals, **connection, "objects.add", {{"object", object}},
                                             Patience::while_alive, print_applied("added"));
}

struct MoveOptions {
    std::string name, to, by;
};

proto::Status move(const Globals& globals, const MoveOptions& options) {
    if (options.to.empty() == options.by.empty())
        return usage_error("a move has one aim", "--to", "give either --to or --by");
    proto::ObjectsMove request;
    request.name = options.name;
    const bool is_absolute = !options.to.empty();
    auto vector = parse_vector(is_absolute ? options.to : options.by, is_absolute ? "--to" : "--by");
    if (!vector) return vector.error();
    (is_absolute ? request.to : request.by) = *vector;
    return command<proto::Applied>(globals, "objects.move", request, Patience::while_alive, print_applied("moved"));
}

}  // namespace

void add_object_commands(CLI::App& app, CommandLine& line) {
    add_command(app, line, "objects", "list the objects", [](const Globals& globals) {
        return command<proto::ObjectsListReply>(globals, "objects.list", proto::ObjectsList{}, Patience::query,
                                                [](const proto::ObjectsListReply& reply) {
                                                    for (const proto::ObjectDesc& object : reply.objects)
                                                        print_line(object_text(object));
                                                });
    });

    auto doomed = std::make_shared<std::string>();
    add_command(app, line, "remove", "remove an object",
                [doomed](const Globals& globals) {
                    return command<proto::Applied>(globals, "objects.remove", proto::ObjectsRemove{*doomed},
                                                   Patience::while_alive, print_applied("removed"));
                })
        ->add_option("NAME", *doomed, "which one")
        ->required();

    auto to_add = std::make_shared<AddOptions>();
    CLI::App* adder = add_command(app, line, "add", "add an object",
                                  [to_add](const Globals& globals) { return add(globals, *to_add); });
    adder->add_option("NAME", to_add->name, "a new name")->required();
    adder->add_option("--box", to_add->box, "corners [m]: x0,y0,z0,x1,y1,z1 (2D: x0,y0,x1,y1)");
    adder->add_option("--sphere", to_add->sphere, "centre and radius [m]: x,y,z,r (2D: x,y,r)");
    adder->add_option("--cylinder", to_add->cylinder,
                      "centres of its flat ends, radius [m]: x0,y0,z0,x1,y1,z1,r; 3D only");
    adder->add_option("--plane", to_add->plane,
                      "a point [m] and the normal towards the fluid: x,y,z,nx,ny,nz (2D: x,y,nx,ny)");
    adder->add_option("--shape", to_add->shape,
                      R"(as in a scene, JSON or a file: '{"box": {"min": [0, 0], "max": [1, 1]}}')");
    adder->add_option("--motion", to_add->motion,
                      R"_(as in a scene, JSON or a file: '{"displacement": ["0.1*sin(t)", 0]}')_");
    adder->add_option("--surface-velocity", to_add->surface_velocity,
                      R"_(of a belt [m/s]: x,y,z, or JSON: '["0.5*t", 0]')_");
    adder->add_option("--slip", to_add->slip, "does the fluid slip along it; default: the model's wall_slip")
        ->check(CLI::IsMember({"free_slip", "no_slip"}));
    adder->add_option("--role", to_add->role, "an obstacle keeps the fluid out, a container keeps it in")
        ->check(CLI::IsMember({"obstacle", "container"}))
        ->capture_default_str();

    auto to_move = std::make_shared<MoveOptions>();
    CLI::App* mover = add_command(app, line, "move", "move an object",
                                  [to_move](const Globals& globals) { return move(globals, *to_move); });
    mover->add_option("NAME", to_move->name, "which one")->required();
    mover->add_option("--to", to_move->to, "new centre of its bounding box, of a plane its point [m]: x,y,z (2D: x,y)");
    mover->add_option("--by", to_move->by, "displacement [m]: x,y,z (2D: x,y)");
}

}  // namespace headrace::client
