// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/self_test.hpp"

#include <algorithm>

namespace hapnet::peer::self_test {

namespace {

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
        return is_skipped ? "left out by --skip" : why_not;
    };
    const DeadMan dead_man = plan.is_real ? DeadMan::person : DeadMan::simulated_hand;
    steps_ = {
        {"read", ReadStep{plan.read_for, plan.capabilities.rate_hz}, asked_for("read", "")},
        {"calibrate", CalibrateStep{}, asked_for("calibrate", "")},
        {"force", ForceStep{dead_man}, asked_for("force", why_no_force(plan))},
        {"cable", CableStep{},
         asked_for("cable", plan.is_real ? "" : "a device that is simulated has none")},
    };
    skip_to_next();
}

Turn SelfTest::on_tick(const Feeling& feeling, base::TimePoint now)
{
    if (at_ == steps_.size()) return {.is_done = true};
    Turn turn =
        std::visit([&](auto& step) { return step.on_tick(feeling, now); }, steps_[at_].step);
    if (!turn.is_done) return turn;
    outcomes_.push_back(
        std::visit([](const auto& step) { return step.outcome(); }, steps_[at_].step));
    ++at_;
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

void SelfTest::stop()
{
    for (; at_ < steps_.size(); ++at_) {
        outcomes_.push_back({steps_[at_].name, Verdict::skipped, "the test was broken off"});
    }
}

} // namespace hapnet::peer::self_test
