// objects, remove, add, move
#include "client/arguments.h"
#include "client/command.h"
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
    std::string name, box, sphere;
    std::string role{"obstacle"};
};

proto::Status add(const Globals& globals, const AddOptions& options) {
    proto::ObjectsAdd request;
    request.object.name = options.name;
    request.object.role = options.role == "container" ? proto::ObjectRole::container : proto::ObjectRole::obstacle;
    if (options.box.empty() == options.sphere.empty())
        return usage_error("an object has one shape", "--box", "give either --box or --sphere");
    if (!options.box.empty()) {
        auto box = parse_box(options.box);
        if (!box) return box.error();
        request.object.shape = *box;
    } else {
        auto sphere = parse_sphere(options.sphere);
        if (!sphere) return sphere.error();
        request.object.shape = *sphere;
    }
    return command<proto::Applied>(globals, "objects.add", request, Patience::while_alive, print_applied("added"));
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
    adder->add_option("--role", to_add->role, "an obstacle keeps the fluid out, a container keeps it in")
        ->check(CLI::IsMember({"obstacle", "container"}))
        ->capture_default_str();

    auto to_move = std::make_shared<MoveOptions>();
    CLI::App* mover = add_command(app, line, "move", "move an object",
                                  [to_move](const Globals& globals) { return move(globals, *to_move); });
    mover->add_option("NAME", to_move->name, "which one")->required();
    mover->add_option("--to", to_move->to, "new centre [m]: x,y,z");
    mover->add_option("--by", to_move->by, "displacement [m]: x,y,z");
}

}  // namespace headrace::client
