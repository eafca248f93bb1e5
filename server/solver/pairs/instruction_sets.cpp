#include "server/solver/pairs/instruction_sets.h"

#include "hwy/highway.h"
#include "hwy/targets.h"

namespace headrace::solver {
namespace {

void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

// Highway says AVX3 for what everybody calls AVX-512.
std::string name_of(std::int64_t target) {
    std::string name = hwy::TargetName(target);
    if (name.starts_with("AVX3")) name.replace(0, 4, "AVX-512");
    return name;
}

}  // namespace

std::vector<std::string> instruction_sets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.push_back(name_of(target));
    return names;
}

std::string instruction_set() {
    return instruction_sets().front();
}

OnlyInstructionSet::OnlyInstructionSet(const std::string& name) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name_of(target) == name) {
            use(target);
            return;
        }
    }
}

OnlyInstructionSet::~OnlyInstructionSet() {
    use(0);
}

}  // namespace headrace::solver
