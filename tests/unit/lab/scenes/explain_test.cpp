// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/scenes/explain.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::lab::scenes {
namespace {

using namespace std::chrono_literals;

bool says(const std::string& text, std::string_view words)
{
    return text.find(words) != std::string::npos;
}

TEST(Explain, ThePapersSceneSlidesAsItsCubeCannotTurn)
{
    const auto explanation = explain(scene::paper_scene(), 1ms, true);
    EXPECT_EQ(explanation.profile, scene::StepperKind::sliding);
    ASSERT_EQ(explanation.cheaper.size(), 1U);
    EXPECT_EQ(explanation.cheaper[0].profile, scene::StepperKind::flight);
    EXPECT_DOUBLE_EQ(explanation.hand_factor.value(), 500.0 * 1e-6 / 0.1);
    const auto text = to_table(explanation);
    EXPECT_TRUE(says(text, "movable 1 (100g); fixed 1; planes 1")) << text;
    EXPECT_TRUE(says(text, "2, of radius 5mm: 500N/m and 2Ns/m, at most 3.3N")) << text;
    EXPECT_TRUE(says(text, "  rotation     off  ")) << text;
    EXPECT_TRUE(says(text, "  drag         on   ")) << text;
    EXPECT_TRUE(
        says(text, "Its stepper: sliding\n  cheaper: flight           has no contact, hips"))
        << text;
}

TEST(Explain, EveryFeatureThatIsOnHasACheaperTickThatLacksIt)
{
    scene::Description description = scene::paper_scene();
    description.bodies[0].turning = scene::Turning::free;
    description.bodies.resize(100, description.bodies[0]);
    description.bodies[1].mass_kg = 100.0;
    description.bodies[1].movable = true;
    const auto explanation = explain(description, 4ms, true);
    EXPECT_EQ(explanation.profile, scene::StepperKind::many);
    EXPECT_EQ(explanation.cheaper.size(), 5U);
    for (const CheaperTick& tick : explanation.cheaper) EXPECT_FALSE(tick.lacks.empty());
    EXPECT_DOUBLE_EQ(explanation.hand_factor.value(), 500.0 * 16e-6 / 0.1);
    EXPECT_TRUE(says(to_table(explanation), "movable 100 (100g to 100kg, 1:1000)"));
}

TEST(Explain, SaysWhatATickTakesAtMost)
{
    scene::Description description = scene::paper_scene();
    description.bodies[0].turning = scene::Turning::free;
    const auto explanation = explain(description, 1ms, true);
    // The cube with the platform, and with the static cube.
    EXPECT_EQ(explanation.bound.contacts, 2U);
    EXPECT_EQ(explanation.bound.pairs, 8U); // a waking tick looks at each pair four times
    const auto text = to_table(explanation);
    EXPECT_TRUE(says(text, "A tick takes at most:\n  8 pairs examined\n")) << text;
    EXPECT_EQ(to_json(explanation)["tick_bound"]["contacts"], 2);
}

TEST(Explain, ASceneWithoutHandsHasNothingToSayOfThem)
{
    scene::Description description;
    description.hands.count = 0;
    description.hands.force_max_n = std::numeric_limits<double>::infinity();
    const auto explanation = explain(description, 1ms, true);
    EXPECT_TRUE(says(to_table(explanation), "hands   none"));
    const auto json = to_json(explanation);
    EXPECT_TRUE(json["mass_kg"].is_null());
    EXPECT_TRUE(json["hand_k_dt2_over_m"].is_null());
    EXPECT_TRUE(json["hips"]["force_max_n"].is_null());
}

TEST(Explain, JsonHasTheSameFeaturesAndTicks)
{
    const auto json = to_json(explain(scene::paper_scene(), 1ms, false));
    EXPECT_EQ(json["profile"], "sliding");
    EXPECT_EQ(json["features"].size(), scene::features);
    EXPECT_EQ(json["features"][0]["feature"], "contact");
    EXPECT_EQ(json["features"][0]["needed"], true);
    EXPECT_EQ(json["cheaper"][0]["lacks"][0], "contact");
    EXPECT_EQ(json["tick_s"], 0.001);
    EXPECT_EQ(json["hash"].get<std::string>().size(), 16U);
}

} // namespace
} // namespace hapnet::lab::scenes
