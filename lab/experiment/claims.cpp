// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/claims.hpp"

#include "lab/experiment/grid.hpp"
#include "lab/virtual_time/world.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace hapnet::lab::experiment {

namespace {

using namespace std::chrono_literals;
using device::Task;

const std::vector<ClaimCell>& cells()
{
    static const std::vector<Task> pressed{Task::t1, Task::t2, Task::t3};
    static const std::vector<Task> tapped{Task::t1, Task::t2, Task::t3, Task::t6};
    static const std::vector<Task> carried{Task::p1, Task::t1, Task::t2, Task::t3};
    static const std::vector<Task> press{Task::t2};
    static const std::vector<ClaimCell> all{
        {.name = "100ms", .delay_ms = 100, .tasks = tapped},
        {.name = "160ms", .delay_ms = 160, .tasks = carried},
        {.name = "200ms", .delay_ms = 200, .tasks = tapped},
        {.name = "300ms", .delay_ms = 300, .tasks = tapped},
        {.name = "jitter-30ms", .delay_ms = 30, .jitter_ms = 30, .tasks = pressed},
        {.name = "loss-97", .loss_percent = 97, .tasks = pressed},
        {.name = "burst-90", .burst_of_100 = 90, .tasks = pressed},
        {.name = settled_cell,
         .delay_ms = 200,
         .jitter_ms = 30,
         .loss_percent = 97,
         .tasks = pressed},
        {.name = "200ms-relaxed", .delay_ms = 200, .tasks = press, .hands = "relaxed"},
        {.name = "200ms-firm", .delay_ms = 200, .tasks = press, .hands = "firm"},
        {.name = "200ms-three", .delay_ms = 200, .tasks = pressed, .peers = 3},
        {.name = "loss-97-three", .loss_percent = 97, .tasks = pressed, .peers = 3},
    };
    return all;
}

emulator::Path path_of(const ClaimCell& cell, const emulator::Path& ground)
{
    constexpr std::int64_t thousand = 1000;
    const GridPoint point{
        {cell.delay_ms * thousand}, {cell.jitter_ms * thousand}, {cell.loss_percent * thousand}};
    return impaired(make_path(ground, point), Impairment::burst_loss,
                    {cell.burst_of_100 * thousand});
}

/// The sessions of one algorithm.
class CellSpecs {
public:
    CellSpecs(const Experiment& experiment, std::size_t algorithm)
        : experiment_{experiment}, algorithm_{experiment.algorithms[algorithm]}
    {}

    [[nodiscard]] SessionSpec spec(const ClaimCell& cell, Task task, std::uint32_t seed) const
    {
        const auto person = device::operator_named(cell.hands);
        base::ensure(person.has_value());
        const Hands hands{*person, *person};
        return make_session_spec(experiment_,
                                 {algorithm_, hands, task, seed, Party{.peers = cell.peers}},
                                 path_of(cell, experiment_.path));
    }

private:
    const Experiment& experiment_;
    const NamedAlgorithm& algorithm_;
};

/// True if all hands are released and away from the body.
bool are_silent(const virtual_time::VirtualWorld& world)
{
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const peer::Tick& last = world.side(side).last();
        if (last.phase != peer::Phase::hands_off || last.touched.touching) return false;
    }
    return true;
}

bool has_ended(const virtual_time::VirtualWorld& world)
{
    for (std::size_t side = 0; side < world.sides(); ++side) {
        const peer::Phase phase = world.side(side).last().phase;
        if (phase == peer::Phase::alone || phase == peer::Phase::ended) return true;
    }
    return false;
}

/// Returns the time from which all hands are silent until the session's end, counted from the
/// beginning of the world; nullopt: there is none.
std::optional<base::Duration> silent_from(const virtual_time::Setting& setting)
{
    using virtual_time::VirtualWorld;
    VirtualWorld world{setting};
    const base::TimePoint latest = VirtualWorld::start + 60s + setting.length;
    bool is_silent = false;
    base::TimePoint since = world.now();
    while (world.now() < latest) {
        world.step();
        if (has_ended(world)) break;
        const bool was_silent = is_silent;
        is_silent = are_silent(world);
        if (is_silent && !was_silent) since = world.now();
    }
    if (!is_silent) return std::nullopt;
    return since - VirtualWorld::start;
}

emulator::Change healing(base::Duration at)
{
    emulator::Change change;
    change.time = at;
    for (emulator::Patch* const way : {&change.up, &change.down}) {
        way->delay = emulator::Variation{};
        way->jitter = emulator::Variation{};
        way->loss = std::vector<emulator::LossLaw>{};
    }
    return change;
}

} // namespace

std::span<const ClaimCell> claim_cells() { return cells(); }

std::vector<Job> claim_jobs(const Experiment& experiment)
{
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
        const CellSpecs specs{experiment, i};
        for (const ClaimCell& cell : claim_cells()) {
            for (const Task task : cell.tasks) {
                for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
                    auto spec = specs.spec(cell, task, experiment.first_seed + seed);
                    jobs.emplace_back(
                        SessionJob{i, task, std::move(spec), Party{.peers = cell.peers}});
                }
            }
        }
    }
    const auto settled = std::ranges::find(claim_cells(), settled_cell, &ClaimCell::name);
    for (std::size_t i = 0; i < experiment.algorithms.size(); ++i) {
        const CellSpecs specs{experiment, i};
        for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
            SessionSpec spec = specs.spec(*settled, Task::t3, experiment.first_seed + seed);
            spec.setting.length = std::min<base::Duration>(spec.setting.length, 10s);
            spec.silence = 1s;
            jobs.emplace_back(SilenceJob{i, std::move(spec)});
        }
    }
    return jobs;
}

base::Result<double> apart_after_silence(const virtual_time::Setting& setting, base::Duration after)
{
    using virtual_time::VirtualWorld;
    const auto at = silent_from(setting);
    if (!at) return base::fail("a session that is to end in silence never began");
    virtual_time::Setting healed = setting;
    healed.profile.timeline = {healing(*at)};
    VirtualWorld world{healed};
    world.run_for(*at + after);
    double apart_m = 0.0;
    for (std::size_t a = 0; a < world.sides(); ++a) {
        for (std::size_t b = a + 1; b < world.sides(); ++b) {
            const auto between = world.side(a).peer().position() - world.side(b).peer().position();
            apart_m = std::max(apart_m, base::norm(between));
        }
    }
    return apart_m;
}

} // namespace hapnet::lab::experiment
