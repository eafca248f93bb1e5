// What only the model can tell: forces on objects, energies.
#include "server/probes/probe.h"
#include "server/probes/vectors.h"

namespace headrace::probes {

namespace {

std::string quoted(const std::string& name) {
    return "\"" + name + "\"";
}

class Force final : public Probe {
  public:
    Force(const proto::ForceProbe& desc, int dimensions) : desc_(desc), dimensions_(dimensions) {}
    std::vector<proto::ProbeColumn> columns() const override {
        if (dimensions_ == 2) return {{"fx", "N/m", {}}, {"fy", "N/m", {}}, {"tz", "N", {}}};
        return {{"fx", "N", {}},   {"fy", "N", {}},   {"fz", "N", {}},
                {"tx", "N m", {}}, {"ty", "N m", {}}, {"tz", "N m", {}}};
    }
    Failure sample(const RunView& run, std::span<const NearParticle>, proto::ProbeRow& values) const override {
        const auto& objects = run.surroundings.objects;
        std::size_t index = 0;
        while (index < objects.size() && objects[index].name != desc_.object) ++index;
        if (index == objects.size()) return "there is no object " + quoted(desc_.object);
        const std::vector<solver::ObjectLoad> loads = run.model.object_loads(run.particles, run.surroundings);
        if (loads.size() != objects.size())
            return "the model " + quoted(std::string(run.model.name())) + " does not tell forces on objects";
        const Vec3& f = loads[index].force;
        // The model's torque is about the origin.
        const Vec3 t = minus(loads[index].torque, cross(desc_.about, f));
        if (dimensions_ == 2)
            values = {f[0], f[1], t[2]};
        else
            values = {f[0], f[1], f[2], t[0], t[1], t[2]};
        return std::nullopt;
    }

  private:
    proto::ForceProbe desc_;
    int dimensions_;
};

class Energies final : public Probe {
  public:
    explicit Energies(int dimensions) : unit_(dimensions == 3 ? "J" : "J/m") {}
    std::vector<proto::ProbeColumn> columns() const override {
        std::vector<proto::ProbeColumn> columns;
        for (const char* name : {"kinetic", "potential", "internal", "dissipated", "work", "balance"})
            columns.push_back({name, unit_, {}});
        return columns;
    }
    Failure sample(const RunView& run, std::span<const NearParticle>, proto::ProbeRow& values) const override {
        const auto budget = run.model.energies(run.particles, run.surroundings);
        if (!budget) return "the model " + quoted(std::string(run.model.name())) + " does not tell energies";
        values = {budget->kinetic,    budget->potential, budget->internal,
                  budget->dissipated, budget->work,      budget->balance};
        return std::nullopt;
    }

  private:
    const char* unit_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const proto::ForceProbe& desc, int dimensions) {
    return std::make_unique<Force>(desc, dimensions);
}

std::unique_ptr<Probe> make_probe(const proto::EnergyProbe&, int dimensions) {
    return std::make_unique<Energies>(dimensions);
}

}  // namespace headrace::probes
