// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/metrics.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

/// A figure of the statistics and its name in Prometheus.
struct Metric {
    std::string_view name;
    std::string_view help;
    const char* pointer; // into the statistics, or into those of a direction
    bool is_counter = true;
    double unit = 1.0; // what the figure is multiplied by
};

constexpr std::array emulator_metrics{
    Metric{"hapnet_emulator_elapsed_seconds", "Time since the emulator began", "/elapsed_s", false},
    Metric{"hapnet_emulator_generation", "How often the conditions have changed, plus one",
           "/generation", false},
};

constexpr std::array way_metrics{
    Metric{"hapnet_emulator_received_total", "Datagrams that came", "/received"},
    Metric{"hapnet_emulator_delivered_total", "Datagrams that left", "/delivered"},
    Metric{"hapnet_emulator_duplicated_total", "Extra copies", "/duplicated"},
    Metric{"hapnet_emulator_corrupted_total", "Datagrams with bits inverted", "/corrupted"},
    Metric{"hapnet_emulator_reordered_total", "Datagrams that were overtaken", "/reordered"},
    Metric{"hapnet_emulator_received_bytes_total", "Payload that came", "/bytes_in"},
    Metric{"hapnet_emulator_delivered_bytes_total", "Payload that left", "/bytes_out"},
    Metric{"hapnet_emulator_in_flight", "Datagrams that wait to leave", "/in_flight", false},
    Metric{"hapnet_emulator_lateness_p99_seconds", "How late 99 % of the datagrams left at most",
           "/lateness_us/p99", false, 1e-6},
};

constexpr std::array peer_metrics{
    Metric{"hapnet_peer_elapsed_seconds", "Time since the first tick", "/elapsed_s", false},
    Metric{"hapnet_peer_ticks_total", "Ticks of the haptic loop", "/tick/count"},
    Metric{"hapnet_peer_ticks_missed_total", "Ticks that were skipped", "/tick/missed"},
    Metric{"hapnet_peer_tick_lateness_p99_seconds", "How late 99 % of the ticks began at most",
           "/tick/late_us/p99", false, 1e-6},
    Metric{"hapnet_peer_states_sent_total", "States that were sent", "/messages/states_sent"},
    Metric{"hapnet_peer_states_received_total", "States that were used",
           "/messages/states_received"},
    Metric{"hapnet_peer_states_outdated_total", "States that came after a newer one",
           "/messages/outdated"},
    Metric{"hapnet_peer_strangers_total", "Datagrams of strangers", "/messages/strangers"},
    Metric{"hapnet_peer_send_failures_total", "Datagrams that could not be sent",
           "/messages/send_failed"},
};

/// Quotes of a label's value.
std::string label_value(std::string_view text)
{
    std::string quoted;
    for (const char c : text) {
        if (c == '\\' || c == '"') quoted += '\\';
        quoted += c == '\n' ? ' ' : c;
    }
    return quoted;
}

class Page {
public:
    void begin(const Metric& metric)
    {
        fmt::format_to(std::back_inserter(text_), "# HELP {0} {1}\n# TYPE {0} {2}\n", metric.name,
                       metric.help, metric.is_counter ? "counter" : "gauge");
    }

    void add(const Metric& metric, const Json& statistics, const std::string& labels)
    {
        const Json::json_pointer place{metric.pointer};
        if (!statistics.is_object() || !statistics.contains(place)) return;
        const Json& value = statistics.at(place);
        if (value.is_number()) add(metric.name, labels, value.get<double>() * metric.unit);
    }

    void add(std::string_view name, const std::string& labels, double value)
    {
        if (!std::isfinite(value)) return;
        fmt::format_to(std::back_inserter(text_), "{}{} {:.15g}\n", name,
                       labels.empty() ? "" : "{" + labels + "}", value);
    }

    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
};

struct Way {
    std::string labels;
    const Json* statistics;
};

/// Those of the only path, or of each.
std::vector<Way> ways_of(const Json& emulator)
{
    std::vector<Way> ways;
    const auto add = [&](const Json& path, const std::string& name) {
        for (const char* direction : {"up", "down"}) {
            const auto found = path.find(direction);
            if (found == path.end() || !found->is_object()) continue;
            const auto labels = name.empty() ? std::string{} : fmt::format("path=\"{}\",", name);
            ways.push_back({fmt::format("{}direction=\"{}\"", labels, direction), &*found});
        }
    };
    if (!emulator.is_object()) return ways;
    const auto links = emulator.find("links");
    if (links == emulator.end() || !links->is_object() || links->empty()) {
        add(emulator, "");
        return ways;
    }
    // Not their sums besides: whoever adds up would count all twice.
    for (const auto& [name, path] : links->items()) {
        if (path.is_object()) add(path, label_value(name));
    }
    return ways;
}

void add_drops(Page& page, const std::vector<Way>& ways)
{
    constexpr Metric dropped{"hapnet_emulator_dropped_total",
                             "Datagrams that were dropped, by cause", ""};
    page.begin(dropped);
    for (const Way& way : ways) {
        const auto causes = way.statistics->find("dropped");
        if (causes == way.statistics->end() || !causes->is_object()) continue;
        for (const auto& [cause, count] : causes->items()) {
            if (!count.is_number()) continue;
            page.add(dropped.name, fmt::format("{},cause=\"{}\"", way.labels, label_value(cause)),
                     count.get<double>());
        }
    }
}

} // namespace

std::string prometheus_text(const nlohmann::ordered_json& emulator,
                            std::span<const nlohmann::ordered_json> peers)
{
    Page page;
    if (emulator.is_object()) {
        for (const Metric& metric : emulator_metrics) {
            page.begin(metric);
            page.add(metric, emulator, "");
        }
        const auto ways = ways_of(emulator);
        for (const Metric& metric : way_metrics) {
            page.begin(metric);
            for (const Way& way : ways) page.add(metric, *way.statistics, way.labels);
        }
        add_drops(page, ways);
    }
    for (const Metric& metric : peer_metrics) {
        if (peers.empty()) break;
        page.begin(metric);
        for (const Json& peer : peers) {
            const Json::json_pointer id{"/peer_id"};
            if (!peer.is_object() || !peer.contains(id)) continue;
            page.add(metric, peer, fmt::format("peer=\"{}\"", label_value(peer.at(id).dump())));
        }
    }
    return page.take();
}

} // namespace hapnet::web
