#include "server/inspection.h"

#include <algorithm>
#include <string>

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;

proto::Result<proto::SimInspectReply> inspect_particle(const scene::Run& run, std::uint32_t id) {
    const std::vector<solver::Index>& ids = run.particles().id;
    if (std::find(ids.begin(), ids.end(), id) == ids.end())
        return Error{ErrorCode::particle_not_found, "no particle " + std::to_string(id), "params.id",
                     ids.empty() ? "there are no particles"
                                 : "ids are 0 to " + std::to_string(*std::max_element(ids.begin(), ids.end()))};
    const auto found = run.model().inspect(run.particles(), run.surroundings(), id);
    if (!found)
        return Error{ErrorCode::invalid_params,
                     "the model \"" + std::string(run.model().name()) + "\" cannot explain a particle", "method",
                     "load the scene with a model that can, such as wcsph"};

    proto::SimInspectReply reply;
    reply.step = run.step_number();
    reply.time = run.time();
    reply.id = found->id;
    reply.position = found->x;
    reply.velocity = found->v;
    reply.acceleration = found->a;
    reply.density = found->rho;
    reply.pressure = found->p;
    reply.concentration = found->concentration;
    reply.min_eigenvalue = found->min_eigenvalue;
    for (const solver::NeighbourInspection& neighbour : found->neighbours) {
        proto::InspectedNeighbour entry{neighbour.id, {}, neighbour.distance, neighbour.weight};
        if (!neighbour.object.empty()) entry.object = neighbour.object;
        reply.neighbours.push_back(std::move(entry));
    }
    for (const solver::TermInspection& term : found->terms) reply.terms.push_back({term.term, term.acceleration});
    return reply;
}

}  // namespace headrace::server
