// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/paths_report.hpp"

#include "emulator/direction_report.hpp"
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

using Json = nlohmann::ordered_json;

std::span<const PathState> present(const RunState& state)
{
    return std::span{state.paths}.first(state.count);
}

/// Of all paths together, those too that have been forgotten.
struct Sums {
    Statistics up;
    Statistics down;
    std::uint64_t strangers_up = 0;
    std::uint64_t strangers_down = 0;
    std::uint64_t overflowed_up = 0;
    std::uint64_t overflowed_down = 0;
    std::size_t paths = 0; // at present

    [[nodiscard]] DirectionOfRun of_up() const
    {
        return {up, nullptr, strangers_up, overflowed_up};
    }
    [[nodiscard]] DirectionOfRun of_down() const
    {
        return {down, nullptr, strangers_down, overflowed_down};
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
              .paths = state.count};
    for (const PathState& path : present(state)) {
        sums.up.add(path.up.statistics);
        sums.down.add(path.down.statistics);
        sums.strangers_up += path.up.strangers;
        sums.strangers_down += path.down.strangers;
        sums.overflowed_up += path.up.overflowed;
        sums.overflowed_down += path.down.overflowed;
    }
    return sums;
}

Json json_of(const PathState& client, const UpstreamRun& run, const RunState& state)
{
    Json json{
        {"client", client.client}, {"name", client.name}, {"address", client.end_a->to_text()}};
    add_course(json, run, client);
    json["up"] = json_of_way(client.up, run, state);
    json["down"] = json_of_way(client.down, run, state);
    return json;
}

Json json_of(const PathState& link, const ports::Relay& relay, const LinksRun& run,
             const RunState& state)
{
    const auto text = [](const std::optional<net::Endpoint>& end) {
        return end ? Json(end->to_text()) : Json(nullptr);
    };
    Json json{{"listen_1", relay.a().local.to_text()},
              {"listen_2", relay.b().local.to_text()},
              {"end_1", text(link.end_a)},
              {"end_2", text(link.end_b)}};
    add_course(json, run, link);
    json["up"] = json_of_way(link.up, run, state);
    json["down"] = json_of_way(link.down, run, state);
    return json;
}

/// `reasons`: what is against it apart from the sums.
void add_sums(Json& json, const AnyRun& run, const Sums& sums, std::vector<std::string> reasons)
{
    const auto budget = run.options.budget;
    for (const auto& [way, direction] :
         {std::pair{"up", sums.of_up()}, std::pair{"down", sums.of_down()}}) {
        for (const std::string& reason : reasons_against(direction, budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    add_validity(json, run, std::move(reasons));
    json["up"] = json_of(sums.of_up(), budget);
    json["down"] = json_of(sums.of_down(), budget);
}

/// Each link has to be on time, not only all together.
std::vector<std::string> reasons_of_links(const RunState& state, base::Duration budget)
{
    std::vector<std::string> reasons = state.failures;
    for (const PathState& link : present(state)) {
        for (const auto& [direction, way] :
             {std::pair{Direction::up, &link.up}, std::pair{Direction::down, &link.down}}) {
            for (const std::string& reason : reasons_against(way->view(), budget)) {
                reasons.push_back(fmt::format("{}: {}", way_name(link.name, direction), reason));
            }
        }
    }
    return reasons;
}

std::string status_of(const RunState& state, std::string_view paths)
{
    const Sums sums = sums_of(state);
    return fmt::format("{:.0f} s | {} {} | {} | {}", base::to_seconds(state.elapsed), sums.paths,
                       paths, in_short("up", sums.of_up()), in_short("down", sums.of_down()));
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

nlohmann::ordered_json statistics_of(const LinksRun& run, const RunState& state)
{
    Json json = head_of(run, state);
    json["generation"] = state.generation;
    json["configuration_at_start"] = configuration_json(run.scenario.profile.path);
    add_files(json, run);
    add_sums(json, run, sums_of(state), reasons_of_links(state, run.options.budget));
    Json links = Json::object();
    const auto& relays = run.port.relays();
    for (std::size_t i = 0; i < state.count; ++i) {
        links[relays[i]->name()] = json_of(state.paths[i], *relays[i], run, state);
    }
    json["links"] = std::move(links);
    add_checks(json, run);
    return json;
}

nlohmann::ordered_json statistics_of(const UpstreamRun& run, const RunState& state)
{
    Json json = head_of(run, state);
    json["listen"] = run.port.local().to_text();
    json["upstream"] = run.port.server().to_text();
    json["clients_seen"] = state.server.clients_seen;
    json["clients_forgotten"] = state.server.departed.count;
    json["refused"] = state.server.refused;
    json["generation"] = state.generation;
    json["configuration_at_start"] = configuration_json(run.scenario.profile.path);
    // Of whoever comes now.
    json["configuration_at_end"] = configuration_json(*state.server.newcomers);
    add_files(json, run);
    add_sums(json, run, sums_of(state), state.failures);
    Json clients = Json::array();
    for (const PathState& client : present(state)) clients.push_back(json_of(client, run, state));
    json["clients"] = std::move(clients);
    add_checks(json, run);
    return json;
}

std::string summary(const LinksRun& run, const RunState& state)
{
    auto text = fmt::format("{:.1f} s, seed {}, {} links\n", base::to_seconds(state.elapsed),
                            run.scenario.seed.value(), state.count);
    for (const PathState& link : present(state)) {
        for (const auto& [direction, way] :
             {std::pair{Direction::up, &link.up}, std::pair{Direction::down, &link.down}}) {
            const auto title = way_name(link.name, direction);
            text += in_words(title.c_str(), way->view(), run.options.budget);
        }
    }
    return text + incomplete(run.recorder) + failures_in_words(state);
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
    return text + in_words("up   (to the server)", sums.of_up(), run.options.budget) +
           in_words("down (to the clients)", sums.of_down(), run.options.budget) +
           incomplete(run.recorder) + failures_in_words(state);
}

std::string status_line(const LinksRun& /*run*/, const RunState& state)
{
    return status_of(state, "links");
}

std::string status_line(const UpstreamRun& /*run*/, const RunState& state)
{
    return status_of(state, "clients");
}

} // namespace hapnet::emulator
