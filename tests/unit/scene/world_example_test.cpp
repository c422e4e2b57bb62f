// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// The example of docs/design/scene.md: the lines between the two marks stand there word for word.
#include "scene/world.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace hapnet {
namespace {

using namespace std::chrono_literals;

// <example>
double cube_after_one_second()
{
    scene::Description description = scene::paper_scene();
    description.hands.count = 1;
    auto world = scene::World::freeze(description, {.tick = 1ms}); // checks; reserves all memory
    if (!world) return 0.0;                                        // world.error().message says why

    scene::HandInput hand{.position = {{-0.024, 0.0, 0.0}}, .velocity = {{0.01, 0.0, 0.0}}};
    for (int tick = 0; tick < 1000; ++tick) {
        if (world->set_hand(0, hand)) return 0.0;         // refused: not finite, or out of range
        world->tick();                                    // 1 ms later
        const base::Force felt = world->touch(0).on_hand; // the mean over the tick
        if (felt.x() > 0.0) return 0.0;                   // a hand from the left is pushed back
        hand.position = hand.position + hand.velocity * base::Duration{1ms};
    }
    return world->position(0).x();
}
// </example>

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in{file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

TEST(SceneExample, StandsInTheDocumentationWordForWord)
{
    const std::filesystem::path here{__FILE__};
    const std::string source = text_of(here);
    const std::string begin = "// <example>\n";
    const std::size_t from = source.find(begin) + begin.size();
    const std::string example = source.substr(from, source.find("// </example>") - from);
    ASSERT_GT(example.size(), 100U);
    const auto root = here.parent_path() / "../../..";
    EXPECT_NE(text_of(root / "docs/design/scene.md").find(example), std::string::npos);
}

TEST(SceneExample, AHandPushesTheCubeBeforeItself)
{
    EXPECT_NEAR(cube_after_one_second(), 0.010, 0.001);
}

} // namespace
} // namespace hapnet
