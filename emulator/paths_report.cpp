// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/paths_report.hpp"

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/direction_words.hpp"
#include "emulator/run_state.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

std::span<const PathState> present(const RunState& state)
{
    return std::span{state.paths}.first(state.count);
}

/// The sums of all paths together, including paths that have been forgotten.
struct Sums {
    Statistics up;
    Statistics down;
    std::uint64_t strangers_up = 0;
    std::uint64_t strangers_down = 0;
    std::uint64_t overflowed_up = 0;
    std::uint64_t overflowed_down = 0;
    std::uint64_t unreachable_up = 0;
    std::uint64_t unreachable_down = 0;
    std::size_t paths = 0; // current number of paths

    [[nodiscard]] DirectionReport of_up(base::Duration budget) const
    {
        return {&up, nullptr, strangers_up, overflowed_up, unreachable_up, budget};
    }
    [[nodiscard]] DirectionReport of_down(base::Duration budget) const
    {
        return {&down, nullptr, strangers_down, overflowed_down, unreachable_down, budget};
    }
};

Sums sums_of(const RunState& state)
{
    const RunState::Server& server = state.server;
    Sums sums{.up = server.departed.up,
              .down = server.departed.down,
              .strangers_up = server.strangers + server.refused,
              .strangers_down = server.departed.strangers_down,
              .overflowed_up = server.overflowed,
              .overflowed_down = server.departed.overflowed_down,
              .unreachable_up = server.departed.unreachable_up,
              .unreachable_down = server.unreachable,
              .paths = state.count};
    for (const auto& flow : server.departed.flows) {
        sums.up.add(flow.up);
        sums.down.add(flow.down);
    }
    for (const PathState& path : present(state)) {
        sums.up.add(path.flows.empty() ? path.up.statistics : path.all_up);
        sums.down.add(path.flows.empty() ? path.down.statistics : path.all_down);
        sums.strangers_up += path.up.strangers;
        sums.strangers_down += path.down.strangers;
        sums.overflowed_up += path.up.overflowed;
        sums.overflowed_down += path.down.overflowed;
        sums.unreachable_up += path.up.unreachable;
        sums.unreachable_down += path.down.unreachable;
    }
    return sums;
}

ClientReport report_of(const PathState& client, const UpstreamRun& run, const RunState& state)
{
    return {.number = client.client,
            .name = client.name,
            .address = client.end_a->to_text(),
            .course = course_of(run, client),
            .up = report_of(client, Direction::up, run, state),
            .down = report_of(client, Direction::down, run, state),
            .flows = flows_of(client, run, state)};
}

LinkEnds ends_of(const PathState& link, const ports::Relay& relay)
{
    const auto text_of = [](const std::optional<net::Endpoint>& end) {
        return end ? std::optional{end->to_text()} : std::nullopt;
    };
    return {.listen_1 = relay.a().local.to_text(),
            .listen_2 = relay.b().local.to_text(),
            .end_1 = text_of(link.end_a),
            .end_2 = text_of(link.end_b)};
}

LinkReport link_report_of(const PathState& link, const AnyRun& run, const RunState& state)
{
    return {.ends = {},
            .course = course_of(run, link),
            .up = report_of(link, Direction::up, run, state),
            .down = report_of(link, Direction::down, run, state),
            .flows = flows_of(link, run, state)};
}

/// The statistics of each flow over all paths together. The traffic in no flow comes last.
struct FlowSums {
    std::vector<Statistics> up;
    std::vector<Statistics> down;
};

FlowSums flow_sums_of(const RunState& state, std::size_t flows)
{
    const auto& departed = state.server.departed;
    FlowSums sums{std::vector<Statistics>(flows + 1), std::vector<Statistics>(flows + 1)};
    const auto add = [&](std::size_t flow, const Statistics& up, const Statistics& down) {
        sums.up[flow].add(up);
        sums.down[flow].add(down);
    };
    for (std::size_t i = 0; i < departed.flows.size(); ++i) {
        add(i, departed.flows[i].up, departed.flows[i].down);
    }
    add(flows, departed.up, departed.down);
    for (const PathState& path : present(state)) {
        for (std::size_t i = 0; i < flows; ++i) {
            add(i, path.flows[i].up.statistics, path.flows[i].down.statistics);
        }
        add(flows, path.up.statistics, path.down.statistics);
    }
    return sums;
}

/// Reports the flows of all paths. `sums` must outlive the statistics.
void tell_of_flows(RunStatistics& statistics, const AnyRun& run, const FlowSums& sums)
{
    const auto& flows = run.scenario.profile.flows;
    if (flows.empty()) return;
    auto& reports = statistics.flows.emplace();
    for (std::size_t i = 0; i <= flows.size(); ++i) {
        const auto name = i < flows.size() ? flows[i].name : std::string{rest_of_flows};
        const auto path = i < flows.size() ? flow_path("", name) : "";
        const auto budget = run.options.budget;
        reports.emplace_back(name,
                             FlowReport{.course = {.at_start = configuration_of(
                                                       profile_of(run.scenario.profile, path).path),
                                                   .at_end = {},
                                                   .changes = {},
                                                   .changes_omitted = {}},
                                        .up = {.statistics = &sums.up[i], .budget = budget},
                                        .down = {.statistics = &sums.down[i], .budget = budget}});
    }
}

/// Reports the sums of both directions, and judges the run. `sums` must outlive the statistics.
/// `reasons`: the objections to the run other than those of the sums.
void tell_of_sums(RunStatistics& statistics, const AnyRun& run, const Sums& sums,
                  std::vector<std::string> reasons)
{
    statistics.up = sums.of_up(run.options.budget);
    statistics.down = sums.of_down(run.options.budget);
    add_reasons(reasons, "up", statistics.up);
    add_reasons(reasons, "down", statistics.down);
    judge(statistics, run, std::move(reasons));
}

/// Returns the objections to each link: each has to be on time, not only all together.
std::vector<std::string> reasons_of_links(const AnyRun& run, const RunState& state)
{
    std::vector<std::string> reasons = state.failures;
    for (const PathState& link : present(state)) {
        for (const auto& [direction, way] :
             {std::pair{Direction::up, &link.up}, std::pair{Direction::down, &link.down}}) {
            add_reasons(reasons, way_name(link.name, direction), report_of(*way, run, state));
        }
        add_reasons(reasons, flows_of(link, run, state));
    }
    for (const auto& [name, report] : state.interfaces) {
        if (const auto overflowed = report.overflowed.value_or(0); overflowed > 0) {
            reasons.push_back(
                fmt::format("{}: the emulator lost {} as overflowed", name, overflowed));
        }
    }
    return reasons;
}

std::string status_of(const AnyRun& run, const RunState& state, std::string_view paths)
{
    const Sums sums = sums_of(state);
    const auto budget = run.options.budget;
    return fmt::format("{:.0f} s | {} {} | {} | {}", base::to_seconds(state.elapsed), sums.paths,
                       paths, in_short("up", sums.of_up(budget)),
                       in_short("down", sums.of_down(budget)));
}

} // namespace

std::string ready_line(const LinksRun& run)
{
    std::string links;
    for (const auto& relay : run.port.relays()) {
        links += fmt::format("{}={},{} ", relay->name(), relay->a().local.to_text(),
                             relay->b().local.to_text());
    }
    return fmt::format("ready {}seed={} timing={}\n", links, run.scenario.seed.value(),
                       base::name_of(run.options.timing));
}

std::string ready_line(const UpstreamRun& run)
{
    return fmt::format("ready listen={} upstream={} seed={} timing={}\n",
                       run.port.local().to_text(), run.port.server().to_text(),
                       run.scenario.seed.value(), base::name_of(run.options.timing));
}

nlohmann::ordered_json json_of_links(RunStatistics statistics, const AnyRun& run,
                                     const RunState& state, std::span<const LinkEnds> ends)
{
    const Sums sums = sums_of(state);
    statistics.course.at_start = configuration_of(run.scenario.profile.path);
    const FlowSums flows = flow_sums_of(state, run.scenario.profile.flows.size());
    tell_of_flows(statistics, run, flows);
    tell_of_sums(statistics, run, sums, reasons_of_links(run, state));
    auto& links = statistics.links.emplace();
    for (const PathState& link : present(state)) {
        links.emplace_back(link.name, link_report_of(link, run, state));
        if (!ends.empty()) links.back().second.ends = ends[links.size() - 1];
    }
    return json_of(statistics, run);
}

nlohmann::ordered_json statistics_of(const LinksRun& run, const RunState& state)
{
    const auto& relays = run.port.relays();
    std::vector<LinkEnds> ends;
    for (std::size_t i = 0; i < state.count; ++i) {
        ends.push_back(ends_of(state.paths[i], *relays[i]));
    }
    return json_of_links(statistics_of_any(run, state), run, state, ends);
}

nlohmann::ordered_json statistics_of(const UpstreamRun& run, const RunState& state)
{
    const Sums sums = sums_of(state);
    RunStatistics statistics = statistics_of_any(run, state);
    statistics.ends.listen = run.port.local().to_text();
    statistics.ends.upstream = run.port.server().to_text();
    statistics.ends.clients_seen = state.server.clients_seen;
    statistics.ends.clients_forgotten = state.server.departed.count;
    statistics.ends.refused = state.server.refused;
    statistics.course.at_start = configuration_of(run.scenario.profile.path);
    // The conditions of a client that would arrive now.
    statistics.course.at_end = configuration_of(*state.server.newcomers);
    const FlowSums flows = flow_sums_of(state, run.scenario.profile.flows.size());
    tell_of_flows(statistics, run, flows);
    tell_of_sums(statistics, run, sums, state.failures);
    auto& clients = statistics.clients.emplace();
    for (const PathState& client : present(state)) {
        clients.push_back(report_of(client, run, state));
    }
    return json_of(statistics, run);
}

std::string words_of_links(const AnyRun& run, const RunState& state)
{
    auto text = fmt::format("{:.1f} s, seed {}, {} links\n", base::to_seconds(state.elapsed),
                            run.scenario.seed.value(), state.count);
    for (const PathState& link : present(state)) {
        for (const auto& [direction, way] :
             {std::pair{Direction::up, &link.up}, std::pair{Direction::down, &link.down}}) {
            const auto title = way_name(link.name, direction);
            text += in_words(title, report_of(*way, run, state));
        }
    }
    return text;
}

std::string summary(const LinksRun& run, const RunState& state)
{
    return words_of_links(run, state) + closing_words(run, state);
}

std::string summary(const UpstreamRun& run, const RunState& state)
{
    const Sums sums = sums_of(state);
    auto text =
        fmt::format("{:.1f} s, seed {}, clients in all: {}\n", base::to_seconds(state.elapsed),
                    run.scenario.seed.value(), state.server.clients_seen);
    if (const auto refused = state.server.refused; refused > 0) {
        text +=
            fmt::format("{} datagrams found no place for their client: raise --clients\n", refused);
    }
    const auto budget = run.options.budget;
    return text + in_words("up   (to the server)", sums.of_up(budget)) +
           in_words("down (to the clients)", sums.of_down(budget)) + closing_words(run, state);
}

std::string status_line(const LinksRun& run, const RunState& state)
{
    return status_of(run, state, "links");
}

std::string status_line(const UpstreamRun& run, const RunState& state)
{
    return status_of(run, state, "clients");
}

} // namespace hapnet::emulator
