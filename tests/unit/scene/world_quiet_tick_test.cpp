// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A tick only computes: it takes no memory and makes no system call.
#include "proto/base/math.hpp"
#include "scene/text/text.hpp"
#include "scene/world.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/scene/bench_scenes.hpp"

#include <gtest/gtest.h>
#include <linux/seccomp.h>
#include <memory>
#include <optional>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <tuple>
#include <unistd.h>

namespace hapnet::scene {
namespace {

World world_named(const char* name)
{
    const base::OpenFile no_files = [](const std::string&) { return base::fail("no files"); };
    const auto built_in = load_scene(name, no_files);
    return World::freeze(built_in ? *built_in : test::bench_scene(name)).value();
}

/// Hands that come, push, squeeze, grip and leave, a body that is moved elsewhere, and a push.
void play(World& world, int ticks)
{
    for (int i = 0; i < ticks; ++i) {
        const double turn = base::two_pi * static_cast<double>(world.ticks()) / 600.0;
        const double x = 0.022 + 0.008 * base::sin(turn);
        std::ignore = world.set_hand(0, {.position = {{-x, 0.0, 0.0}}});
        std::ignore = world.set_hand(
            1, {.position = {{x, 0.0, 0.0}}, .velocity = {}, .gripping = i % 500 > 400});
        if (i % 300 == 299) std::ignore = world.place(0, {.position = {{0.0, 0.01, 0.0}}});
        std::ignore = world.push(0, {{0.01, 0.0, 0.0}});
        world.tick();
    }
}

class QuietTick : public testing::TestWithParam<const char*> {};

TEST_P(QuietTick, TakesNoMemoryAlsoInACopyAndAfterARestore)
{
    World world = world_named(GetParam());
    World copy = world;
    const World::Snapshot snapshot = world.snapshot();
    const auto before = test::allocations();
    play(world, 1500);
    play(copy, 1500);
    world.restore(snapshot);
    play(world, 500);
    copy.restore(world);
    play(copy, 500);
    EXPECT_EQ(test::allocations(), before);
}

#ifndef HAPNET_SANITIZED // a sanitizer asks the system for memory of its own
/// Runs `work` in a process that is killed for any system call but read, write and exit. Returns
/// its wait status; nullopt where such a cage cannot be had.
template <typename Work>
std::optional<int> caged(Work work)
{
    constexpr int no_cage = 77;
    const pid_t child = fork();
    if (child == 0) {
        if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) _exit(no_cage);
        work();
        syscall(SYS_exit, 0); // _exit() asks for more than that
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) return std::nullopt;
    if (WIFEXITED(status) && WEXITSTATUS(status) == no_cage) return std::nullopt;
    return status;
}

TEST_P(QuietTick, AsksTheSystemForNothing)
{
    World world = world_named(GetParam());
    const auto status = caged([&] { play(world, 1000); });
    if (!status) GTEST_SKIP() << "no seccomp here";
    EXPECT_EQ(*status, 0) << "signal " << WTERMSIG(*status);
}

TEST(QuietTick, WouldBeNoticedIfItWereNot)
{
    const auto before = test::allocations();
    EXPECT_EQ(*std::make_unique<int>(7), 7);
    EXPECT_GT(test::allocations(), before);
    const auto status = caged([] { syscall(SYS_getpid); });
    if (!status) GTEST_SKIP() << "no seccomp here";
    EXPECT_TRUE(WIFSIGNALED(*status));
}
#endif

INSTANTIATE_TEST_SUITE_P(Scene, QuietTick,
                         testing::Values("paper", "push-6dof", "stack-10", "cubes-100", "conveyor",
                                         "soft-and-hard", "guide", "stick-slip", "rolling"));

} // namespace
} // namespace hapnet::scene
