// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A foot switch of the kernel as a dead man's switch. The switch is emulated: what is real is the
// daemons.
#include "tests/e2e/peer.hpp"
#include "tests/support/umockdev/handler.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <deque>
#include <gtest/gtest.h>
#include <linux/input.h>
#include <mutex>
#include <string>

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
    void unplug()
    {
        const std::lock_guard lock{mutex_};
        has_gone_ = true;
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
        if (has_gone_) {
            request.fail(ENODEV);
        } else if (events_.empty()) {
            request.fail(EAGAIN);
        } else {
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
    bool has_gone_ = false;
    umockdev::Testbed testbed_;
    std::optional<umockdev::Attachment> attachment_; // last: it ends before what it uses
};

} // namespace

TEST(DeadMan, IsAFootSwitchWhoseReleaseOrUnpluggingEndsTheForce)
{
    FootSwitch pedal;
    const TemporaryFolder folder;
    const std::string socket = folder.file("a.sock");
    const std::vector<std::string> task{"--task", "T3", "--duration", "120s"};
    std::vector<std::string> options = task;
    options.insert(options.end(),
                   {"--dead-man", std::string{"evdev:"} + FootSwitch::node, "--control", socket});
    const std::string place_a = free_place();
    const std::string place_b = free_place();
    Peer a{1, place_a, place_b, options};
    Peer b{2, place_b, place_a, task};
    EXPECT_TRUE(pedal.is_grabbed());
    EXPECT_TRUE(a.says("session started"));
    const auto is_pushed = [&] { return answer_of(socket, "show").value("force_n", 0.0) > 0.1; };
    const auto is_withheld = [&] {
        const auto shown = answer_of(socket, "show");
        return shown.value("force_withheld", false) && shown.value("force_n", 1.0) == 0.0;
    };
    EXPECT_TRUE(comes_true(is_withheld));
    pedal.press(true);
    EXPECT_TRUE(comes_true(is_pushed, 60s));
    pedal.press(false);
    EXPECT_TRUE(comes_true(is_withheld));
    pedal.press(true);
    EXPECT_TRUE(comes_true(is_pushed, 60s));
    pedal.unplug();
    EXPECT_TRUE(comes_true(is_withheld));
    a.stop_on_a_busy_machine();
    b.stop_on_a_busy_machine();
    EXPECT_GT(a.statistics()["governor"]["withheld"], 10);
    expect_the_same_forces_again(a.record());
}

} // namespace hapnet::e2e
