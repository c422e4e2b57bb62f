// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/watched_rig.hpp"
#include "proto/net/clock.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <memory>

namespace hapnet::peer::loop {
namespace {

/// A device that gets the force late: only after the watchdog released it.
class LateDevice final : public device::Device {
public:
    enum class Word : std::uint8_t { none, apply, halt };

    [[nodiscard]] const device::Identity& identity() const override { return identity_; }
    [[nodiscard]] const device::Capabilities& capabilities() const override { return can_; }
    [[nodiscard]] device::Sample read(base::TimePoint /*now*/) override { return {}; }
    void apply(const device::GovernedForce& /*force*/) override
    {
        last_word_.wait(Word::none);
        watchdog->rest(); // the watchdog stops, and the rig must do the rest
        last_word_ = Word::apply;
    }
    void halt() noexcept override
    {
        last_word_ = Word::halt;
        last_word_.notify_all();
    }
    [[nodiscard]] Word last_word() const { return last_word_; }

    Watchdog* watchdog = nullptr;

private:
    device::Identity identity_;
    device::Capabilities can_;
    std::atomic<Word> last_word_{Word::none};
};

TEST(WatchedRig, TakesBackAForceThatReachedTheDeviceAfterItsHalt)
{
    auto owned = std::make_unique<LateDevice>();
    LateDevice& device = *owned;
    device::Rig rig{std::move(owned), device::GovernorLimits{}};
    Watchdog watchdog{device};
    device.watchdog = &watchdog;
    const base::TimePoint now = net::monotonic_now();
    WatchedRig watched{rig, watchdog};
    watchdog.beat(now);
    watched.apply(base::Force{{1.0, 0.0, 0.0}}, true, now);
    EXPECT_EQ(watchdog.halts(), 1U);
    EXPECT_EQ(device.last_word(), LateDevice::Word::halt);
}

} // namespace
} // namespace hapnet::peer::loop
