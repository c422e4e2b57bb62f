// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// soak_scene FIRST COUNT [compounds]: plays the random scenes of the seeds FIRST ..
// FIRST + COUNT - 1 under the laws; with `compounds`, of bodies of several parts. Prints every seed
// that breaks one, and at the end the worst of each, and how often the ticks had to step in. With
// HAPNET_SOAK_GUARDS set, also every seed in which a guard acted. Exits 0 when none is broken.
//
// soak_scene everyday FIRST COUNT TICK_US: plays COUNT scenes of each everyday kind with such a
// tick and prints, by kind, how many gain energy, at most how much, and how many bodies leave the
// room. Exits 0 when no scene gains more than is allowed and nothing leaves.
//
// soak_scene --worst FIRST COUNT [BODIES]: of the same scenes with at most so many movable bodies
// (8) prints the ticks that take longest.
#include "tests/soak/worst_ticks.hpp"
#include "tests/support/scene/everyday.hpp"
#include "tests/support/scene/scene_laws.hpp"

#include <algorithm>
#include <cstdlib>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace {

namespace scene = hapnet::scene;
using hapnet::test::LawFigures;

struct Tally {
    std::uint64_t played = 0;
    std::uint64_t ticks = 0;
    std::uint64_t broken = 0;
    LawFigures worst;
    scene::Interventions interventions;
};

void keep(LawFigures& worst, const LawFigures& one)
{
    worst.energy = std::max(worst.energy, one.energy);
    worst.momentum = std::max(worst.momentum, one.momentum);
    worst.angular_momentum = std::max(worst.angular_momentum, one.angular_momentum);
    worst.force = std::max(worst.force, one.force);
}

void report(const Tally& tally)
{
    fmt::print("  {} scenes, {} ticks, {} broken; worst: energy {:.3g}, momentum {:.3g}, "
               "angular {:.3g} of what is tolerated; force {:.10g} of the greatest\n",
               tally.played, tally.ticks, tally.broken, tally.worst.energy, tally.worst.momentum,
               tally.worst.angular_momentum, tally.worst.force);
    const scene::Interventions& done = tally.interventions;
    fmt::print(
        "  guards: {} in {:.2g} of the ticks: {} islands limited, {} ways cut, {} budgets "
        "spent; mechanisms: {} impulses trimmed, {} hands braked, {} bounces limited, {} sweeps "
        "continued, {} clusters stuck, {} islands solved anew\n",
        done.guards(), static_cast<double>(done.guards()) / static_cast<double>(tally.ticks),
        done.islands_limited, done.paths_cut, done.budgets_spent, done.impulses_trimmed,
        done.hands_braked, done.bounces_limited, done.sweeps_continued, done.clusters_stuck,
        done.islands_anew);
    std::fflush(stdout);
}

/// The results of the plays of one everyday kind.
struct EverydayTally {
    std::uint64_t above = 0;     // plays that gain more than 1e-4 of their scale
    std::uint64_t far_above = 0; // ... more than 1 %
    std::uint64_t escaped = 0;
    double worst = 0.0;
    std::uint64_t worst_seed = 0;
};

EverydayTally play_kind(hapnet::test::Everyday kind, std::uint64_t first, std::uint64_t count,
                        hapnet::base::Duration tick)
{
    constexpr double some = 1e-4, much = 1e-2;
    EverydayTally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const auto play = hapnet::test::everyday_play(kind, seed, tick);
        const auto outcome = hapnet::test::play_everyday(play);
        if (outcome.gain > some) ++tally.above;
        if (outcome.gain > much) ++tally.far_above;
        if (outcome.has_escaped) ++tally.escaped;
        if (std::getenv("HAPNET_SOAK_SEEDS") != nullptr &&
            (outcome.gain > some || outcome.has_escaped))
            fmt::print("    {} {}: gain {:.3g}{}\n", name_of(kind), seed, outcome.gain,
                       outcome.has_escaped ? ", escaped" : "");
        if (outcome.gain <= tally.worst) continue;
        tally.worst = outcome.gain;
        tally.worst_seed = seed;
    }
    return tally;
}

/// Returns whether all plays keep the laws.
bool play_everyday_kinds(std::uint64_t first, std::uint64_t count, hapnet::base::Duration tick)
{
    using hapnet::test::Everyday;
    // In a thousand plays at 4 ms, or of very unequal masses, a few may gain a little.
    const bool is_coarse = tick > std::chrono::milliseconds{2};
    bool all_kept = true;
    for (std::size_t i = 0; i < hapnet::test::everyday_kinds; ++i) {
        const auto kind = static_cast<Everyday>(i);
        const EverydayTally tally = play_kind(kind, first, count, tick);
        fmt::print("  {} us, {}: {} plays, {} gain more than 1e-4, {} more than 1 %; {} escapes; "
                   "worst {:.3g} (seed {})\n",
                   tick.count() / 1000, name_of(kind), count, tally.above, tally.far_above,
                   tally.escaped, tally.worst, tally.worst_seed);
        std::fflush(stdout);
        const bool keeps = kind == Everyday::hostile ? tally.far_above * 1000 <= count
                           : is_coarse               ? tally.above * 5000 <= count
                                                     : tally.above == 0;
        const bool may_escape = kind == Everyday::hostile || is_coarse;
        const bool stay = may_escape ? tally.escaped * 500 <= count : tally.escaped == 0;
        all_kept = all_kept && keeps && stay;
    }
    return all_kept;
}

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const auto number = [&](std::size_t index) {
        return std::strtoull(arguments[index].c_str(), nullptr, 10);
    };
    if (arguments.size() >= 3 && arguments.size() <= 4 && arguments[0] == "--worst") {
        hapnet::soak::WorstTicks asked{.first = number(1), .count = number(2)};
        if (arguments.size() == 4) asked.bodies_max = number(3);
        hapnet::soak::print_worst_ticks(asked);
        return 0;
    }
    if (arguments.size() == 4 && arguments[0] == "everyday") {
        const std::chrono::microseconds tick{number(3)};
        return play_everyday_kinds(number(1), number(2), tick) ? 0 : 1;
    }
    const bool compounds = arguments.size() == 3 && arguments[2] == "compounds";
    if (arguments.size() != 2 && !compounds) {
        fmt::print(stderr, "usage: soak_scene FIRST COUNT [compounds]\n"
                           "       soak_scene everyday FIRST COUNT TICK_US\n"
                           "       soak_scene --worst FIRST COUNT [BODIES]\n");
        return 2;
    }
    const std::uint64_t first = number(0);
    const std::uint64_t count = number(1);
    constexpr std::uint64_t often = 10'000;
    Tally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const auto play = hapnet::test::random_play(seed, {.compounds = compounds});
        const auto outcome = hapnet::test::judge(play, seed);
        ++tally.played;
        tally.ticks += play.ticks.size();
        keep(tally.worst, outcome.worst);
        tally.interventions += outcome.interventions;
        if (std::getenv("HAPNET_SOAK_GUARDS") != nullptr && outcome.interventions.guards() > 0)
            fmt::print("  seed {}: {} guards\n", seed, outcome.interventions.guards());
        if (outcome.complaint) {
            ++tally.broken;
            fmt::print("  seed {}: {}\n", seed, *outcome.complaint);
        }
        if (tally.played % often == 0) report(tally);
    }
    report(tally);
    return tally.broken == 0 ? 0 : 1;
}
