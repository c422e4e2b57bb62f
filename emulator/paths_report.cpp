// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/paths_report.hpp"

#include "emulator/direction_report.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

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

Sums sums_of(const ports::Upstream& port)
{
    const auto departed = port.departed();
    Sums sums{.up = departed.up,
              .down = departed.down,
              .strangers_up = port.strangers() + port.refused(),
              .strangers_down = departed.strangers_down,
              .overflowed_up = port.overflowed(),
              .overflowed_down = departed.overflowed_down};
    for (const auto* client : port.clients()) {
        ++sums.paths;
        sums.up.add(client->path->link(Direction::up).statistics());
        sums.down.add(client->path->link(Direction::down).statistics());
        sums.strangers_down += client->strangers;
        sums.overflowed_down += client->socket.overflowed();
    }
    return sums;
}

Sums sums_of(const ports::Links& port)
{
    Sums sums;
    for (const auto& relay : port.relays()) {
        const auto& a = relay->a();
        const auto& b = relay->b();
        ++sums.paths;
        sums.up.add(a.link.statistics());
        sums.down.add(b.link.statistics());
        sums.strangers_up += a.strangers;
        sums.strangers_down += b.strangers;
        sums.overflowed_up += a.socket.overflowed();
        sums.overflowed_down += b.socket.overflowed();
    }
    return sums;
}

Json json_of(const ports::Upstream::Client& client, const UpstreamRun& run)
{
    const Link& up = client.path->link(Direction::up);
    const Link& down = client.path->link(Direction::down);
    Json json{
        {"client", client.number}, {"name", client.name}, {"address", client.address->to_text()}};
    add_course(json, run, *client.path, client.name);
    json["up"] = json_of_way({up.statistics(), &up.stream_statistics()}, run);
    json["down"] = json_of_way({down.statistics(), &down.stream_statistics(), client.strangers,
                                client.socket.overflowed()},
                               run);
    return json;
}

Json json_of(const ports::Relay& relay, const LinksRun& run)
{
    const auto address = [](const ports::Relay::Side& side) {
        const auto& known = side.filter.address();
        return known ? Json(known->to_text()) : Json(nullptr);
    };
    const auto& a = relay.a();
    const auto& b = relay.b();
    Json json{{"listen_1", a.local.to_text()},
              {"listen_2", b.local.to_text()},
              {"end_1", address(a)},
              {"end_2", address(b)}};
    add_course(json, run, relay.path(), relay.name());
    json["up"] = json_of_way(direction_of(a), run);
    json["down"] = json_of_way(direction_of(b), run);
    return json;
}

/// `reasons`: what is against it apart from the sums.
void add_sums(Json& json, const Sums& sums, base::Duration budget, std::vector<std::string> reasons)
{
    for (const auto& [way, direction] :
         {std::pair{"up", sums.of_up()}, std::pair{"down", sums.of_down()}}) {
        for (const std::string& reason : reasons_against(direction, budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    json["valid"] = reasons.empty();
    json["invalid_because"] = reasons;
    json["up"] = json_of(sums.of_up(), budget);
    json["down"] = json_of(sums.of_down(), budget);
}

/// Each link has to be on time, not only all together.
std::vector<std::string> reasons_of_links(const LinksRun& run)
{
    const auto budget = run.options.budget;
    std::vector<std::string> reasons = run.failures;
    for (const auto& relay : run.port.relays()) {
        for (const auto* side : {&relay->a(), &relay->b()}) {
            for (const std::string& reason : reasons_against(direction_of(*side), budget)) {
                reasons.push_back(
                    fmt::format("{}: {}", way_name(relay->name(), side->direction), reason));
            }
        }
    }
    return reasons;
}

template <typename Run>
std::string status_of(const Run& run, std::string_view paths)
{
    const Sums sums = sums_of(run.port);
    return fmt::format("{:.0f} s | {} {} | {} | {}", base::to_seconds(run.elapsed), sums.paths,
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
                       to_text(run.options.timing));
}

std::string ready_line(const UpstreamRun& run)
{
    return fmt::format("ready listen={} upstream={} seed={} timing={}\n",
                       run.port.local().to_text(), run.port.server().to_text(),
                       run.scenario.seed.value(), to_text(run.options.timing));
}

nlohmann::ordered_json statistics_of(const LinksRun& run)
{
    const auto budget = run.options.budget;
    Json json = head_of(run);
    json["generation"] = run.paths.generation();
    json["configuration_at_start"] = configuration_json(run.scenario.profile.path);
    add_files(json, run);
    add_sums(json, sums_of(run.port), budget, reasons_of_links(run));
    Json links = Json::object();
    for (const auto& relay : run.port.relays()) links[relay->name()] = json_of(*relay, run);
    json["links"] = std::move(links);
    add_checks(json, run);
    return json;
}

nlohmann::ordered_json statistics_of(const UpstreamRun& run)
{
    Json json = head_of(run);
    json["listen"] = run.port.local().to_text();
    json["upstream"] = run.port.server().to_text();
    json["clients_seen"] = run.port.clients_seen();
    json["clients_forgotten"] = run.port.departed().count;
    json["refused"] = run.port.refused();
    json["generation"] = run.paths.generation();
    json["configuration_at_start"] = configuration_json(run.scenario.profile.path);
    // Of whoever comes now.
    json["configuration_at_end"] = configuration_json(run.paths.deciders().back().director->path());
    add_files(json, run);
    add_sums(json, sums_of(run.port), run.options.budget, run.failures);
    Json clients = Json::array();
    for (const auto* client : run.port.clients()) clients.push_back(json_of(*client, run));
    json["clients"] = std::move(clients);
    add_checks(json, run);
    return json;
}

std::string summary(const LinksRun& run)
{
    auto text = fmt::format("{:.1f} s, seed {}, {} links\n", base::to_seconds(run.elapsed),
                            run.scenario.seed.value(), run.port.relays().size());
    for (const auto& relay : run.port.relays()) {
        for (const auto* side : {&relay->a(), &relay->b()}) {
            const auto title = way_name(relay->name(), side->direction);
            text += in_words(title.c_str(), direction_of(*side), run.options.budget);
        }
    }
    return text + incomplete(run.recorder) + failures_in_words(run);
}

std::string summary(const UpstreamRun& run)
{
    const Sums sums = sums_of(run.port);
    auto text =
        fmt::format("{:.1f} s, seed {}, clients in all: {}\n", base::to_seconds(run.elapsed),
                    run.scenario.seed.value(), run.port.clients_seen());
    if (const auto refused = run.port.refused(); refused > 0) {
        text +=
            fmt::format("{} datagrams found no place for their client: raise --clients\n", refused);
    }
    return text + in_words("up   (to the server)", sums.of_up(), run.options.budget) +
           in_words("down (to the clients)", sums.of_down(), run.options.budget) +
           incomplete(run.recorder) + failures_in_words(run);
}

std::string status_line(const LinksRun& run) { return status_of(run, "links"); }

std::string status_line(const UpstreamRun& run) { return status_of(run, "clients"); }

} // namespace hapnet::emulator
