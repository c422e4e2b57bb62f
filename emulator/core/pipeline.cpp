// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/pipeline.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator {

Pipeline::Pipeline(std::vector<Impairment> stages) : stages_{std::move(stages)} {}

Verdict Pipeline::on_packet(std::uint64_t number) const
{
    base::Duration after{0};
    for (const Impairment& stage : stages_) {
        const Verdict verdict =
            std::visit([number](const auto& s) { return s.on_packet(number); }, stage);
        if (std::holds_alternative<Drop>(verdict)) return verdict;
        after += std::get<Deliver>(verdict).after;
    }
    return Deliver{std::max(after, base::Duration{0})};
}

} // namespace hapnet::emulator
