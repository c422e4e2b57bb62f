// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A foot switch of the kernel as a dead man's switch. The switch is emulated: what is real is the
// daemons.
#include "proto/net/clock.hpp"
#include "proto/record/reader.hpp"
#include "tests/e2e/peer.hpp"
#include "tests/support/umockdev/handler.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <deque>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// The kernel's evdev in front of a pedal.
class FootSwitch final : private umockdev::Handler {
public:
    FootSwitch()
    {
        testbed_.add("P: /devices/virtual/input/input9/event9\nN: input/event9\n"
                     "E: DEVNAME=/dev/input/event9\nE: SUBSYSTEM=input\n");
        attachment_.emplace(testbed_, node, static_cast<umockdev::Handler&>(*this));
    }

    static constexpr const char* node = "/dev/input/event9";

    void press(bool down)
    {
        const std::lock_guard lock{mutex_};
        is_down_ = down;
        input_event event{};
        event.type = EV_KEY;
        event.code = KEY_B;
        event.value = down ? 1 : 0;
        events_.push_back(event);
    }
    /// Makes all further reads fail, with ENODEV as after it was unplugged.
    void fail(int error)
    {
        const std::lock_guard lock{mutex_};
        error_ = error;
    }
    /// Returns when the program learned of each end of a press: a release, or the first error.
    [[nodiscard]] std::vector<base::TimePoint> ends()
    {
        const std::lock_guard lock{mutex_};
        return ends_;
    }
    [[nodiscard]] bool is_grabbed()
    {
        const std::lock_guard lock{mutex_};
        return is_grabbed_;
    }

private:
    [[nodiscard]] bool on_ioctl(const umockdev::Request& request) override
    {
        const std::lock_guard lock{mutex_};
        if (request.code() == EVIOCGRAB) {
            is_grabbed_ = true;
            request.succeed();
            return true;
        }
        std::array<std::byte, KEY_CNT / 8> keys{};
        if (request.code() != EVIOCGKEY(keys.size())) return false;
        if (is_down_) keys[KEY_B / 8] = static_cast<std::byte>(1U << (KEY_B % 8));
        request.argument(keys.size()).write(0, keys);
        request.succeed(static_cast<long>(keys.size()));
        return true;
    }
    [[nodiscard]] bool on_read(const umockdev::Request& request) override
    {
        const std::lock_guard lock{mutex_};
        if (error_ != 0) {
            if (!has_failed_) ends_.push_back(net::monotonic_now());
            has_failed_ = true;
            request.fail(error_);
        } else if (events_.empty()) {
            request.fail(EAGAIN);
        } else {
            if (events_.front().value == 0) ends_.push_back(net::monotonic_now());
            umockdev::Memory buffer = request.buffer();
            buffer.write_as(events_.front());
            events_.pop_front();
            request.succeed(sizeof(input_event));
        }
        return true;
    }

    std::mutex mutex_;
    std::deque<input_event> events_;
    bool is_down_ = false;
    bool is_grabbed_ = false;
    int error_ = 0;
    bool has_failed_ = false;
    std::vector<base::TimePoint> ends_;
    umockdev::Testbed testbed_;
    std::optional<umockdev::Attachment> attachment_; // the last member, because it uses the others
};

/// A hand that plays with a pedal, and the other one.
class PedalSession {
public:
    PedalSession() : options_{"--task", "T3", "--duration", "120s"}
    {
        std::vector<std::string> with_pedal = options_;
        with_pedal.insert(with_pedal.end(), {"--dead-man", std::string{"evdev:"} + FootSwitch::node,
                                             "--control", socket_});
        a_.emplace(1, place_a_, place_b_, with_pedal);
        b_.emplace(2, place_b_, place_a_, options_);
        EXPECT_TRUE(pedal.is_grabbed());
        EXPECT_TRUE(a_->says("session started"));
    }
    [[nodiscard]] bool comes_to_be_pushed() const
    {
        const auto is_pushed = [&] {
            return answer_of(socket_, "show").value("force_n", 0.0) > 0.1;
        };
        return comes_true(is_pushed, 60s);
    }
    [[nodiscard]] bool comes_to_be_withheld() const
    {
        return comes_true([&] {
            const auto shown = answer_of(socket_, "show");
            return shown.value("force_withheld", false) && shown.value("force_n", 1.0) == 0.0;
        });
    }
    /// Ends the session. Expects that each end of a press ended the force within two ticks.
    void expect_all_ends_in_time(std::size_t ends)
    {
        a_->stop_on_a_busy_machine();
        b_->stop_on_a_busy_machine();
        EXPECT_GT(a_->statistics()["governor"]["withheld"], 10);
        const auto recorded = record::read(a_->record());
        ASSERT_TRUE(recorded.has_value());
        ASSERT_EQ(pedal.ends().size(), ends);
        for (const base::TimePoint end : pedal.ends()) expect_zero_after(recorded->ticks, end);
        expect_the_same_forces_again(a_->record());
    }

    FootSwitch pedal; // of the first

private:
    static void expect_zero_after(const std::vector<record::TickRow>& ticks, base::TimePoint end)
    {
        constexpr std::ptrdiff_t lately = 200;
        const auto first = std::find_if(ticks.begin(), ticks.end(),
                                        [&](const record::TickRow& row) { return row.at() > end; });
        ASSERT_GE(ticks.end() - first, 10);
        ASSERT_GE(first - ticks.begin(), lately);
        const auto has_force = [](const record::TickRow& row) {
            return row.device != base::Force{};
        };
        EXPECT_TRUE(std::any_of(first - lately, first, has_force)) << "there was a force to end";
        EXPECT_TRUE(std::none_of(first + 2, first + 10, has_force));
    }

    TemporaryFolder folder_;
    std::string socket_ = folder_.file("a.sock");
    std::string place_a_ = free_place();
    std::string place_b_ = free_place();
    std::vector<std::string> options_;
    std::optional<Peer> a_;
    std::optional<Peer> b_;
};

} // namespace

TEST(DeadMan, IsAFootSwitchWhoseReleaseOrUnpluggingEndsTheForceWithinTwoTicks)
{
    PedalSession session;
    EXPECT_TRUE(session.comes_to_be_withheld());
    for (const bool is_unplugged : {false, true}) {
        session.pedal.press(true);
        EXPECT_TRUE(session.comes_to_be_pushed());
        if (is_unplugged)
            session.pedal.fail(ENODEV);
        else
            session.pedal.press(false);
        EXPECT_TRUE(session.comes_to_be_withheld());
    }
    session.expect_all_ends_in_time(2);
}

TEST(DeadMan, IsAFootSwitchThatEndsTheForceWithinTwoTicksWhenItCannotBeRead)
{
    PedalSession session;
    session.pedal.press(true);
    EXPECT_TRUE(session.comes_to_be_pushed());
    session.pedal.fail(EIO);
    EXPECT_TRUE(session.comes_to_be_withheld());
    session.expect_all_ends_in_time(1);
}

} // namespace hapnet::e2e
