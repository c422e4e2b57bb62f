// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/cable_step.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

StepRequest CableStep::on_tick(const StepInput& input, base::TimePoint now)
{
    if (!start_) start_ = now;
    if (!heard_ || input.sample.sequence != sequence_) heard_ = now;
    sequence_ = input.sample.sequence;
    fault_ = input.sample.fault;
    was_well_ = was_well_ || fault_ == device::Fault::none;
    silent_for_ = now - *heard_;
    const bool is_over = fault_ != device::Fault::none || now - *start_ >= patience;
    return {.is_done = is_over, .prompt = Prompt::pull_cable};
}

Outcome CableStep::outcome() const
{
    Outcome outcome{.step = "cable", .verdict = Verdict::skipped, .text = "no cable was pulled"};
    if (fault_ == device::Fault::none) return outcome;
    if (!was_well_) {
        outcome.verdict = Verdict::failed;
        outcome.text = fmt::format("the device was at fault before its cable could be pulled: {}",
                                   device::describe(fault_));
        return outcome;
    }
    const double noticed_ms = 1e3 * base::to_seconds(silent_for_);
    const bool is_loss = fault_ == device::Fault::disconnected ||
                         fault_ == device::Fault::timeout || fault_ == device::Fault::communication;
    outcome.verdict = is_loss ? Verdict::passed : Verdict::failed;
    outcome.noticed_after = silent_for_;
    outcome.text = fmt::format("noticed {:.0f} ms after its last report, as {}", noticed_ms,
                               device::name_of(fault_));
    return outcome;
}

} // namespace hapnet::peer::self_test
