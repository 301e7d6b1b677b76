// Finds the constants that a method plans by their type.
#pragma once

#include <vector>

#include "cloth/method.h"

namespace drape::test {

/// Calls visit(push) for every step of a scheme whose constants are `Push`; those of a const scheme cannot be changed.
template <class Push, class Plan, class Visit>
void for_pushes(Plan& scheme, const Visit& visit) {
    for (auto* steps : {&scheme.prediction, &scheme.once, &scheme.iterated})
        for (auto& step : *steps)
            if (auto* push = std::get_if<Push>(&step.constants)) visit(*push);
}

template <class Push>
std::vector<Push> pushes(const MethodScheme& scheme) {
    std::vector<Push> all;
    for_pushes<Push>(scheme, [&](const Push& push) { all.push_back(push); });
    return all;
}

}  // namespace drape::test
