// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/run_state.hpp"

#include "emulator/core/path_name.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace hapnet::emulator {

namespace {

/// The number of bytes that a step copies before it leaves the rest to the next step.
constexpr std::size_t step_bytes = 64 << 10;

/// Copies the state of a direction. Returns the approximate number of copied bytes.
std::size_t look_at(const Link& link, base::Duration elapsed, WayState& state)
{
    state.regimes = link.regime_course(elapsed);
    state.statistics = link.statistics();
    state.stream = link.stream_statistics().totals();
    const StreamTotals& stream = state.stream;
    return sizeof(WayState) / 50 + state.statistics.lateness.filled_bytes() +
           state.statistics.sojourn.filled_bytes() + stream.delays.delays().filled_bytes() +
           stream.delays.variations().filled_bytes() + stream.gaps.filled_bytes() +
           (stream.over_time ? stream.over_time->stretches().size() * sizeof(Stretch) : 0);
}

/// Copies the state of a path with the last `changes_max` changes, and of its flows. Room for them
/// must exist.
std::size_t look_at(const EmulatedPath& path, std::size_t changes_max, PathState& state)
{
    std::size_t bytes = 0;
    if (const Branches* branches = path.branches()) {
        state.unknown_fragments = branches->unknown_fragments();
        for (std::size_t i = 0; i < branches->paths().size(); ++i) {
            state.flows[i].elapsed = state.elapsed;
            bytes += look_at(*branches->paths()[i], changes_max, state.flows[i]);
        }
    }
    const std::span all{path.changes().entries()};
    const auto last = all.last(std::min(all.size(), changes_max));
    state.changes.assign(last.begin(), last.end());
    state.changes_omitted = path.changes().omitted() + (all.size() - last.size());
    state.conditions = path.director().shared_path();
    return bytes + look_at(path.link(Direction::up), state.elapsed, state.up) +
           look_at(path.link(Direction::down), state.elapsed, state.down) +
           last.size() * sizeof(ConditionChange);
}

/// Returns the number of a path's changes to report: all of them once the run is over.
std::size_t told_changes(const RunState& state, std::size_t paths)
{
    // While the run lasts, clients may request them many times a second.
    constexpr std::size_t while_it_runs = 20;
    if (state.is_over) return ChangeLog::entries_max;
    return std::max(while_it_runs / std::max(paths, std::size_t{1}), std::size_t{1});
}

/// Makes room for this number of paths and their flows.
void make_room(const AnyRun& run, std::size_t paths, RunState& state)
{
    if (state.paths.size() < paths) state.paths.resize(paths);
    for (PathState& path : state.paths) path.flows.resize(run.scenario.profile.flows.size());
}

/// Sets the names of the flows, and adds up their statistics. It does not read the paths any more.
void sum_up_flows(const AnyRun& run, RunState& state)
{
    const auto& flows = run.scenario.profile.flows;
    if (flows.empty()) return;
    for (std::size_t i = 0; i < state.count; ++i) {
        PathState& path = state.paths[i];
        path.all_up = path.up.statistics;
        path.all_down = path.down.statistics;
        for (std::size_t flow = 0; flow < flows.size(); ++flow) {
            path.flows[flow].name = flow_path(path.name, flows[flow].name);
            path.all_up.add(path.flows[flow].up.statistics);
            path.all_down.add(path.flows[flow].down.statistics);
        }
    }
}

void end_look(const AnyRun& run, RunState& state)
{
    state.elapsed = run.elapsed;
    state.generation = run.paths.generation();
    if (state.failures != run.failures) state.failures = run.failures;
}

std::size_t look_at(const ports::Relay& relay, std::size_t changes_max, PathState& state)
{
    const auto bytes = look_at(relay.path(), changes_max, state);
    state.end_a = relay.a().filter.address();
    state.end_b = relay.b().filter.address();
    state.up.strangers = relay.a().strangers;
    state.up.overflowed = relay.a().socket.overflowed();
    state.up.unreachable = relay.b().socket.unreachable();
    state.down.unreachable = relay.a().socket.unreachable();
    state.down.strangers = relay.b().strangers;
    state.down.overflowed = relay.b().socket.overflowed();
    return bytes;
}

std::size_t look_at(const ports::Upstream::Client& client, std::size_t changes_max,
                    PathState& state)
{
    const auto bytes = look_at(*client.path, changes_max, state);
    state.name = client.name;
    state.client = client.number;
    state.end_a = client.address;
    state.down.strangers = client.strangers;
    state.down.overflowed = client.socket.overflowed();
    state.up.unreachable = client.socket.unreachable();
    return bytes;
}

/// `overflowed`: the number of frames that the socket lost, if their direction is not known; else
/// nullopt.
void look_at(const ports::Frames::End& end, std::optional<std::uint64_t> overflowed,
             InterfaceReport& report)
{
    report.undisturbed = end.undisturbed;
    report.not_ip = end.not_ip;
    report.oversized = end.oversized;
    report.lost_undisturbed = end.lost_undisturbed;
    report.told_too_big = end.told_too_big;
    report.overflowed = overflowed;
}

/// Sets the names of the interfaces before the look, because no memory may be allocated while a
/// thread waits.
void make_room(const ports::Frames& port, InterfaceReports& reports)
{
    if (reports.size() == port.ends().size()) return;
    for (const auto& end : port.ends()) {
        reports.emplace_back(end.name, InterfaceReport{.interface = end.interface});
    }
}

void look_at(const ports::Frames& port, RunState& state)
{
    const bool has_one_path = port.pairs().size() == 1;
    for (std::size_t i = 0; i < port.ends().size(); ++i) {
        const auto& end = port.ends()[i];
        const auto overflowed = end.socket.overflowed();
        look_at(end, has_one_path ? std::nullopt : std::optional{overflowed},
                state.interfaces[i].second);
        if (!has_one_path) continue;
        PathState& path = state.paths.front();
        (i == 0 ? path.up : path.down).overflowed = overflowed;
    }
}

/// Removes the clients that are not in `present`. The others stay in their order.
void keep_present(const std::vector<std::uint64_t>& present, RunState& state)
{
    const auto end = state.paths.begin() + static_cast<std::ptrdiff_t>(state.count);
    const auto last = std::stable_partition(state.paths.begin(), end, [&](const PathState& one) {
        return std::ranges::find(present, one.client) != present.end();
    });
    state.count = static_cast<std::size_t>(last - state.paths.begin());
}

} // namespace

void look_at(const AnyRun& run, const ports::Links& port, const control::DoWork& work,
             RunState& state)
{
    const auto& relays = port.relays();
    make_room(run, relays.size(), state);
    state.count = 0;
    work([&] {
        for (std::size_t bytes = 0; state.count < relays.size() && bytes < step_bytes;) {
            PathState& path = state.paths[state.count];
            const ports::Relay& relay = *relays[state.count++];
            path.elapsed = run.elapsed;
            bytes += look_at(relay, told_changes(state, relays.size()), path);
        }
        if (state.count < relays.size()) return false;
        end_look(run, state);
        return true;
    });
    for (std::size_t i = 0; i < relays.size(); ++i) state.paths[i].name = relays[i]->name();
    sum_up_flows(run, state);
}

void look_at(const AnyRun& run, const ports::Upstream& port, const control::DoWork& work,
             RunState& state)
{
    state.count = 0;
    std::size_t wanted = 1;
    std::vector<std::uint64_t> present;
    const auto step = [&] {
        const auto clients = port.clients(); // ordered by their numbers, which only grow
        std::size_t bytes = 0;
        for (const auto* client : clients) {
            if (state.count > 0 && client->number <= state.paths[state.count - 1].client) continue;
            if (bytes >= step_bytes) return false;
            if (state.count == state.paths.size()) {
                wanted = clients.size() + 8;
                return true;
            }
            PathState& path = state.paths[state.count++];
            path.elapsed = run.elapsed;
            bytes += look_at(*client, told_changes(state, clients.size()), path);
        }
        for (const auto* client : clients) present.push_back(client->number);
        state.server = {port.clients_seen(),
                        port.refused(),
                        port.strangers(),
                        port.overflowed(),
                        port.unreachable(),
                        port.departed(),
                        {}};
        state.server.newcomers = run.paths.deciders().back().director->shared_path();
        end_look(run, state);
        wanted = 0;
        return true;
    };
    // Makes room here, because the relaying thread must not wait for memory.
    while (wanted > 0) {
        make_room(run, wanted, state);
        present.reserve(state.paths.size());
        work(step);
    }
    // A client that has gone in the meantime is included in the sums of departed clients.
    keep_present(present, state);
    sum_up_flows(run, state);
}

void look_at(const AnyRun& run, const ports::Frames& port, const control::DoWork& work,
             RunState& state)
{
    const auto& pairs = port.pairs();
    make_room(run, pairs.size(), state);
    make_room(port, state.interfaces);
    state.count = 0;
    work([&] {
        for (std::size_t bytes = 0; state.count < pairs.size() && bytes < step_bytes;) {
            PathState& path = state.paths[state.count];
            const ports::Frames::Pair& pair = pairs[state.count++];
            path.elapsed = run.elapsed;
            bytes += look_at(pair.path, told_changes(state, pairs.size()), path);
            path.up.unreachable = pair.unreachable_up;
            path.down.unreachable = pair.unreachable_down;
        }
        if (state.count < pairs.size()) return false;
        look_at(port, state);
        end_look(run, state);
        return true;
    });
    for (std::size_t i = 0; i < pairs.size(); ++i) state.paths[i].name = pairs[i].name;
    sum_up_flows(run, state);
}

} // namespace hapnet::emulator
