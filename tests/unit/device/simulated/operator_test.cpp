// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/hand_noise.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/reactions.hpp"
#include "device/simulated/task_options.hpp"
#include "proto/base/fields.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace hapnet::device {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

base::Result<Operator> read(const std::string& text)
{
    return load_operator("hand.toml",
                         [&](const std::string&) -> base::Result<std::string> { return text; });
}

std::string complaint(const std::string& text) { return read(text).error().message; }

TEST(Operator, HasPresetsOfThreeGripsAndOneThatReacts)
{
    EXPECT_EQ(operator_named("relaxed")->hand, (HandImpedance{0.15, 3.0, 100.0}));
    EXPECT_EQ(operator_named("nominal").value(), Operator{});
    EXPECT_EQ(operator_named("firm")->hand, (HandImpedance{0.25, 10.0, 500.0}));
    EXPECT_EQ(operator_named("nominal")->reflex.gain, 0.0);
    EXPECT_EQ(operator_named("lifelike")->reflex.gain, 0.2);
    EXPECT_EQ(operator_named("lifelike")->force_noise, 3_percent);
    EXPECT_EQ(operator_named("norminal").error().message,
              "'norminal' is not an operator: did you mean 'nominal'?");
}

TEST(Operator, IsReadFromWhatDiffersFromAPreset)
{
    const auto person = read("preset = \"firm\"\n"
                             "name = \"old hand\"\n"
                             "damping = \"7Ns/m\"\n"
                             "tremor = { amplitude = \"0.2mm\" }\n"
                             "force_noise = \"4%\"\n"
                             "[reflex]\n"
                             "gain = 0.25\n"
                             "delay = \"45ms\"\n");
    ASSERT_TRUE(person);
    EXPECT_EQ(person->name, "old hand");
    EXPECT_EQ(person->hand, (HandImpedance{0.25, 7.0, 500.0}));
    EXPECT_EQ(person->tremor, (InvoluntaryMotion{2e-4, 8.0, 12.0}));
    EXPECT_EQ(person->force_noise, 4_percent);
    EXPECT_EQ(person->reflex, (Reflex{0.25, 45ms}));
    EXPECT_EQ(person->intent, Operator{}.intent);
}

TEST(Operator, IsRefusedWithFileAndLine)
{
    EXPECT_EQ(complaint("mass = \"200g\"\nstifness = \"2N/m\"\n"),
              "hand.toml:2:1: unknown key 'stifness': did you mean 'stiffness'?");
    EXPECT_EQ(complaint("mass = \"0g\""), "hand.toml:1:8: '0g' is out of range: use 20g to 10kg");
    EXPECT_EQ(complaint("will.delay = \"2s\""),
              "hand.toml:1:14: '2s' is out of range: use 0ms to 1s");
    EXPECT_EQ(complaint("preset = \"fierce\"").substr(0, 15), "hand.toml:1:10:");
}

TEST(Operator, PrintsAsTextThatReadsBackAsTheSame)
{
    for (const auto* name : {"relaxed", "nominal", "firm", "lifelike"}) {
        for (std::uint32_t i = 0; i < 5; ++i) {
            const Operator person = varied(operator_named(name).value(), base::Seed{3}, i, 5);
            EXPECT_EQ(read(print_operator(person)), person) << print_operator(person);
        }
    }
}

TEST(Operator, VariesEveryParameterEvenlyOverThirtyPercentOfItself)
{
    constexpr std::uint32_t of = 10;
    const Operator person = operator_named("lifelike").value();
    const auto slices = [&](auto value) {
        std::set<int> result;
        for (std::uint32_t i = 0; i < of; ++i) {
            const double share = value(varied(person, base::Seed{1}, i, of)) / value(person);
            result.insert(static_cast<int>(std::floor((share - 0.7) / 0.6 * of)));
        }
        return result;
    };
    const std::set<int> all{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    EXPECT_EQ(slices([](const Operator& o) { return o.hand.mass_kg; }), all);
    EXPECT_EQ(slices([](const Operator& o) { return o.hand.damping_ns_per_m; }), all);
    EXPECT_EQ(slices([](const Operator& o) { return o.hand.stiffness_n_per_m; }), all);
    EXPECT_EQ(slices([](const Operator& o) { return o.force_noise.fraction(); }), all);
    EXPECT_EQ(slices([](const Operator& o) { return base::to_seconds(o.intent.delay); }), all);
    EXPECT_EQ(varied(person, base::Seed{1}, 4, of), varied(person, base::Seed{1}, 4, of));
    EXPECT_EQ(varied({}, base::Seed{1}, 4, of).reflex.gain, 0.0);
}

TEST(HandNoise, OfTheForceHasItsStandardDeviation)
{
    Operator person;
    person.force_noise = 4_percent;
    const HandNoise noise{base::Seed{5}, 1, person};
    double squares = 0.0;
    constexpr int count = 100'000;
    for (int i = 0; i < count; ++i) {
        const double share = noise.at(0.01 * i).force_share;
        squares += share * share;
    }
    EXPECT_NEAR(std::sqrt(squares / count), 0.04, 0.0004); // three sines over 1000 s
    EXPECT_EQ((HandNoise{base::Seed{5}, 1, {}}.at(1.0).force_share), 0.0);
    // Switching it on does not change the rest.
    EXPECT_EQ(noise.at(1.0).away_m, (HandNoise{base::Seed{5}, 1, {}}.at(1.0).away_m));
}

TEST(SignalHistory, SaysWhatWasSoLongAgoAndHoldsInBetween)
{
    SignalHistory line;
    const base::TimePoint start{1h};
    EXPECT_EQ(line.at(start).x, 0.0);
    for (int ms = 0; ms < 3000; ++ms) {
        line.put(start + ms * 1ms, {1.0 + ms, 0.0, 0.0});
        const double expected = ms < 50 ? 0.0 : ms - 49.0;
        ASSERT_EQ(line.at(start + ms * 1ms - 50ms).x, expected) << ms;
    }
    EXPECT_EQ(line.at(start + 2990ms + 500us).x, 2991.0);
}

TEST(Reactions, OfTheReflexPullBackWhatWasStretched50MsAgo)
{
    Operator person;
    person.reflex.gain = 0.2;
    Reactions reactions{person};
    base::TimePoint now{1h};
    for (int ms = 0; ms < 200; ++ms, now += 1ms) {
        const auto reaction = reactions.to({.deviation = {0.005, 0.0, -0.001 * ms}}, now, 1ms);
        EXPECT_NEAR(reaction.force.x, ms < 50 ? 0.0 : -0.2 * 200.0 * 0.005, 1e-15) << ms;
        EXPECT_NEAR(reaction.force.z, ms < 50 ? 0.0 : 0.2 * 200.0 * 0.001 * (ms - 50), 1e-12);
    }
}

TEST(Reactions, OfTheWillAddUpWhatWasMissing150MsAgo)
{
    Reactions reactions{Operator{}};
    base::TimePoint now{1h};
    double before = 0.0;
    for (int ms = 0; ms < 150; ++ms, now += 1ms) {
        EXPECT_EQ(reactions.to({.pressing_n = 0.2, .wanted_n = 0.7}, now, 1ms).farther_m, 0.0);
    }
    for (int ms = 0; ms < 2000; ++ms, now += 1ms) {
        before = reactions.to({.pressing_n = 0.2, .wanted_n = 0.7}, now, 1ms).farther_m;
    }
    // 10 mm/Ns * 0.5 N for 2 s less the low-pass' 1 / (2 pi 1.5 Hz).
    EXPECT_NEAR(before, 0.010 * 0.5 * (2.0 - 0.1061), 1e-5);
    for (int ms = 0; ms < 20'000; ++ms, now += 1ms) {
        before = reactions.to({.pressing_n = 0.2, .wanted_n = 0.7}, now, 1ms).farther_m;
    }
    EXPECT_EQ(before, 0.020); // and no farther
    for (int ms = 0; ms < 1000; ++ms, now += 1ms) {
        before = reactions.to({.pressing_n = 0.2}, now, 1ms).farther_m;
    }
    EXPECT_LT(before, 1e-5); // nothing is wanted any more
}

TEST(Reactions, OfTheSearchGoOnUntilTheBodyIsFeltAndWaitForTheTaskThere)
{
    Operator person;
    person.search.speed_m_per_s = 0.05;
    Reactions reactions{person};
    base::TimePoint now{1h};
    const auto played = [&](const Perception& felt, int ticks) {
        double farther = 0.0;
        for (int i = 0; i < ticks; ++i, now += 1ms)
            farther = reactions.to(felt, now, 1ms).farther_m;
        return farther;
    };
    const auto free = [](double aim) { return Perception{.aim_m = aim}; };
    const auto touching = [](double aim) { return Perception{.pressing_n = 0.2, .aim_m = aim}; };
    EXPECT_EQ(played(free(0.0), 400), 0.0) << "so long it may be just late";
    EXPECT_NEAR(played(free(0.0), 200), 0.010, 1e-12);
    EXPECT_NEAR(played(touching(0.0), 500), 0.010, 1e-12) << "it stays where the body is";
    EXPECT_NEAR(played(touching(0.004), 1), 0.006, 1e-12) << "until its task has come as far";
    EXPECT_NEAR(played(touching(0.001), 1), 0.006, 1e-12) << "and goes back with it";
    EXPECT_NEAR(played(free(0.001), 400), 0.006, 1e-12);
    EXPECT_EQ(played(free(0.001), 5000), person.search.reach_m) << "and no farther";
    EXPECT_NEAR(played(Perception{}, 200), person.search.reach_m - 0.010, 1e-12);
    EXPECT_EQ(played(Perception{}, 5000), 0.0) << "the task does not mean to touch";
}

TEST(TaskOptions, AreReadAndPrintedWithTheirUnits)
{
    const TaskOptions options{.squeeze_n = 0.4, .press_hertz = 0.8, .pace = 1.0};
    const auto document = base::parse_document(base::field_lines(options));
    ASSERT_TRUE(document);
    base::Reading reading{"task"};
    TaskOptions again;
    base::read_table(*document, again, reading);
    EXPECT_EQ(again, options);
    base::read_table(*base::parse_document("pace = 5"), again, reading);
    EXPECT_EQ(*reading.complaint(), "task:1:8: 5 is out of range: use 0.1 to 2");
}

} // namespace
} // namespace hapnet::device
