// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/self_test.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::peer::self_test {

namespace {

/// Returns the required rate. A pointer without motors may send nothing while no hand touches it.
double rate_wanted_hz(const device::Capabilities& capabilities)
{
    return capabilities.axes_out > 0 ? capabilities.rate_hz : 0.0;
}

std::string why_no_force(const Plan& plan)
{
    if (plan.capabilities.axes_out == 0) return "the device gives no force";
    if (plan.is_real && plan.capabilities.buttons == 0) {
        return "the device has no button to let go of, and nothing else would stop it at once";
    }
    return "";
}

} // namespace

SelfTest::SelfTest(const Plan& plan)
{
    const auto asked_for = [&](std::string_view name, std::string why_not) {
        const bool is_skipped =
            std::find(plan.skip.begin(), plan.skip.end(), name) != plan.skip.end();
        return is_skipped ? "left out by --skip" : std::move(why_not);
    };
    const DeadMan dead_man = plan.is_real ? DeadMan::person : DeadMan::simulated_hand;
    steps_ = {
        {"read", ReadStep{plan.read_for, rate_wanted_hz(plan.capabilities)}, asked_for("read", "")},
        {"calibrate", CalibrateStep{}, asked_for("calibrate", "")},
        {"force", ForceStep{dead_man}, asked_for("force", why_no_force(plan))},
        {"cable", CableStep{},
         asked_for("cable", plan.is_real ? "" : "a device that is simulated has none")},
    };
    skip_to_next();
}

StepRequest SelfTest::on_tick(const StepInput& input, base::TimePoint now)
{
    if (at_ == steps_.size()) return {.is_done = true};
    auto& step = steps_[at_].step;
    StepRequest request = std::visit([&](auto& one) { return one.on_tick(input, now); }, step);
    const bool is_lost = input.sample.fault == device::Fault::disconnected &&
                         !std::holds_alternative<CableStep>(step);
    if (!request.is_done && !is_lost) return request;
    outcomes_.push_back(std::visit([](const auto& one) { return one.outcome(); }, step));
    ++at_;
    if (is_lost) {
        outcomes_.back().verdict = Verdict::failed;
        outcomes_.back().text = device::describe(device::Fault::disconnected);
        skip_rest("the device has gone");
        return {.is_done = true};
    }
    skip_to_next();
    return {.is_done = at_ == steps_.size()};
}

void SelfTest::skip_to_next()
{
    while (at_ < steps_.size() && !steps_[at_].why_not.empty()) {
        outcomes_.push_back({steps_[at_].name, Verdict::skipped, steps_[at_].why_not});
        ++at_;
    }
}

void SelfTest::skip_rest(std::string_view why)
{
    for (; at_ < steps_.size(); ++at_) {
        const bool is_left_out = !steps_[at_].why_not.empty();
        is_cut_short_ = is_cut_short_ || !is_left_out;
        outcomes_.push_back({steps_[at_].name, Verdict::skipped,
                             is_left_out ? steps_[at_].why_not : std::string{why}});
    }
}

} // namespace hapnet::peer::self_test
