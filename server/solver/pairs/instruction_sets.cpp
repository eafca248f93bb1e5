#include "server/solver/pairs/instruction_sets.h"

#include "hwy/highway.h"
#include "hwy/targets.h"

namespace headrace::solver {
namespace {

void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> instruction_sets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
    return names;
}

std::string instruction_set() {
    return instruction_sets().front();
}

OnlyInstructionSet::OnlyInstructionSet(const std::string& name) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (hwy::TargetName(target) == name) {
            use(target);
            return;
        }
    }
}

OnlyInstructionSet::~OnlyInstructionSet() {
    use(0);
}

}  // namespace headrace::solver
