// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/command_start.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::net {
namespace {

using namespace std::chrono_literals;

/// Two commands that only have to start.
struct TwoCommands : testing::Test {
    TwoCommands()
    {
        first.prepare();
        last.prepare();
    }

    std::vector<CommandStart::Before> before(std::function<bool()> is_ready)
    {
        return {{.command = first, .is_ready = std::move(is_ready)}};
    }

    /// Waits as long as it takes; a test that hangs is stopped from outside.
    static void expect_done(const CommandStart& start)
    {
        while (!wait_readable(std::array{start.descriptor()}, monotonic_now() + 1h)) {}
        EXPECT_TRUE(start.is_done());
    }

    ChildCommand first{{.words = {"sleep", "infinity"}, .has_own_group = true}};
    ChildCommand last{{.words = {"sleep", "infinity"}, .has_own_group = true}};
};

TEST_F(TwoCommands, AreStartedWhileTheCallersThreadGoesOn)
{
    std::promise<void> leave;
    std::thread::id looked_on;
    CommandStart start{last, before([&, left = leave.get_future().share()] {
                           looked_on = std::this_thread::get_id();
                           left.wait(); // as long as a look at the kernel's tables may take
                           return true;
                       })};
    EXPECT_FALSE(start.is_done());
    leave.set_value();
    expect_done(start);
    EXPECT_NE(looked_on, std::this_thread::get_id());
}

TEST_F(TwoCommands, AreStartedAfterAWhileInAnyCase)
{
    const auto begin = monotonic_now();
    const CommandStart start{last, before([] { return false; })};
    expect_done(start);
    EXPECT_GE(monotonic_now() - begin, CommandStart::patience);
}

TEST_F(TwoCommands, AreStartedWithoutTheFirstOnceItHasEnded)
{
    ChildCommand brief{{.words = {"true"}}};
    brief.prepare();
    const CommandStart start{last, std::vector{CommandStart::Before{brief, [] { return false; }}}};
    expect_done(start);
}

TEST_F(TwoCommands, AreStartedAtOnceWhenToldToHurry)
{
    CommandStart start{last, before([] { return false; })};
    start.hurry();
    expect_done(start);
}

TEST_F(TwoCommands, AreNotStartedAfterTheEnd)
{
    std::optional<CommandStart> start{std::in_place, last, before([] { return false; })};
    start.reset();
    const auto program = "/proc/" + std::to_string(last.pid()) + "/exe";
    EXPECT_TRUE(std::filesystem::equivalent(program, "/proc/self/exe")) << "it is another by now";
}

TEST_F(TwoCommands, SayWhichOneCannotBeStarted)
{
    ChildCommand missing{{.words = {"/no/such/command"}}};
    missing.prepare();
    const CommandStart start{missing, std::vector<CommandStart::Before>{}};
    while (!wait_readable(std::array{start.descriptor()}, monotonic_now() + 1h)) {}
    EXPECT_THROW(std::ignore = start.is_done(), std::system_error);
}

} // namespace
} // namespace hapnet::net
