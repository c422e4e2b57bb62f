// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/upstream_report.hpp"

#include "emulator/checks.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/report.hpp"
#include "proto/base/version.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// Of all clients, those too that have been forgotten.
struct Sums {
    Statistics up;
    Statistics down;
    std::uint64_t strangers_up = 0;
    std::uint64_t strangers_down = 0;
    std::uint64_t overflowed_up = 0;
    std::uint64_t overflowed_down = 0;
    std::size_t clients = 0; // at present

    explicit Sums(const ports::Upstream& port)
        : up{port.departed().up},
          down{port.departed().down},
          strangers_up{port.strangers() + port.refused()},
          strangers_down{port.departed().strangers_down},
          overflowed_up{port.overflowed()},
          overflowed_down{port.departed().overflowed_down}
    {
        for (const auto& client : port.clients()) {
            if (!client) continue;
            ++clients;
            up.add(client->path.link(Direction::up).statistics());
            down.add(client->path.link(Direction::down).statistics());
            strangers_down += client->strangers;
            overflowed_down += client->socket.overflowed();
        }
    }
    [[nodiscard]] DirectionOfRun of_up() const
    {
        return {up, nullptr, strangers_up, overflowed_up};
    }
    [[nodiscard]] DirectionOfRun of_down() const
    {
        return {down, nullptr, strangers_down, overflowed_down};
    }
};

nlohmann::ordered_json json_of_client(const ports::Upstream::Client& client, base::Duration budget)
{
    const Link& up = client.path.link(Direction::up);
    const Link& down = client.path.link(Direction::down);
    return {{"client", client.number},
            {"address", client.address->to_text()},
            {"up", json_of(DirectionOfRun{up.statistics(), &up.stream_statistics()}, budget)},
            {"down", json_of(DirectionOfRun{down.statistics(), &down.stream_statistics(),
                                            client.strangers, client.socket.overflowed()},
                             budget)}};
}

} // namespace

std::string ready_line(const UpstreamRun& run)
{
    return fmt::format("ready listen={} upstream={} seed={} timing={}\n",
                       run.port.local().to_text(), run.port.server().to_text(),
                       run.scenario.seed.value(), to_text(run.options.run.timing));
}

nlohmann::ordered_json statistics_of(const UpstreamRun& run)
{
    const auto budget = run.options.run.budget;
    const Sums sums{run.port};
    std::vector<std::string> reasons;
    for (const auto& [way, direction] :
         {std::pair{"up", sums.of_up()}, std::pair{"down", sums.of_down()}}) {
        for (const std::string& reason : reasons_against(direction, budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    auto clients = nlohmann::ordered_json::array();
    for (const auto& client : run.port.clients()) {
        if (client) clients.push_back(json_of_client(*client, budget));
    }
    nlohmann::ordered_json json{
        {"program", "hapnet-emulator"},
        {"version", base::version()},
        {"commit", base::commit()},
        {"compiler", base::compiler()},
        {"seed", run.scenario.seed.value()},
        {"timing", to_text(run.options.run.timing)},
        {"budget_us", json_in_us(budget)},
        {"duration_s", base::to_seconds(run.elapsed)},
        {"real_time",
         {{"fifo", run.real_time.fifo}, {"locked_memory", run.real_time.locked_memory}}},
        {"listen", run.port.local().to_text()},
        {"upstream", run.port.server().to_text()},
        {"clients_seen", run.port.clients_seen()},
        {"clients_forgotten", run.port.clients_forgotten()},
        {"refused", run.port.refused()},
        {"configuration_at_start", configuration_json(run.scenario.profile.path)},
        {"profile", to_text(run.scenario.profile)},
        {"valid", reasons.empty()},
        {"invalid_because", reasons},
        {"up", json_of(sums.of_up(), budget)},
        {"down", json_of(sums.of_down(), budget)},
        {"clients", std::move(clients)},
    };
    if (!run.scenario.checks.empty()) json["checks"] = judged(run.scenario.checks, json);
    return json;
}

std::string summary(const UpstreamRun& run)
{
    const Sums sums{run.port};
    auto text = fmt::format("{:.1f} s, seed {}, {} clients in all\n", base::to_seconds(run.elapsed),
                            run.scenario.seed.value(), run.port.clients_seen());
    if (const auto refused = run.port.refused(); refused > 0) {
        text +=
            fmt::format("{} datagrams found no place for their client: raise --clients\n", refused);
    }
    return text + in_words("up   (to the server)", sums.of_up(), run.options.run.budget) +
           in_words("down (to the clients)", sums.of_down(), run.options.run.budget);
}

std::string status_line(const UpstreamRun& run)
{
    const Sums sums{run.port};
    return fmt::format("{:.0f} s | {} clients | {} | {}", base::to_seconds(run.elapsed),
                       sums.clients, in_short("up", sums.of_up()),
                       in_short("down", sums.of_down()));
}

} // namespace hapnet::emulator
