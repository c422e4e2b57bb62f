// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/print.hpp"

#include "proto/base/csv.hpp"
#include "proto/base/text.hpp"
#include "proto/output/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <spdlog/fmt/fmt.h>

namespace hapnet::ctl {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the value at a pointer such as "/up/received"; null if there is none.
Json at(const Json& json, const std::string& pointer)
{
    const Json::json_pointer place{pointer};
    return json.contains(place) ? json[place] : Json(nullptr);
}

std::string text_of(const Json& value)
{
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (value.is_null()) return "-";
    return value.dump();
}

std::string text_at(const Json& json, const std::string& pointer)
{
    return text_of(at(json, pointer));
}

/// Returns a line for each value: "up.received,100".
std::string csv_lines(const Json& json, const std::string& key)
{
    if (!json.is_structured()) {
        const std::string text = json.is_string() ? json.get<std::string>()
                                 : json.is_null() ? std::string{}
                                                  : json.dump();
        return fmt::format("{},{}\n", base::csv_quoted(key), base::csv_quoted(text));
    }
    std::string lines;
    for (const auto& [name, value] : json.items()) { // the names in a list are 0, 1, ...
        lines += csv_lines(value, key.empty() ? name : key + '.' + name);
    }
    return lines;
}

double number_at(const Json& json, const std::string& pointer)
{
    const Json value = at(json, pointer);
    return value.is_number() ? value.get<double>() : 0.0;
}

std::uint64_t total_of(const Json& dropped)
{
    std::uint64_t total = 0;
    if (!dropped.is_object()) return total;
    for (const auto& count : dropped) {
        if (count.is_number_unsigned()) total += count.get<std::uint64_t>();
    }
    return total;
}

/// True for an answer of a peer, including a peer of a session in virtual time.
bool is_from_peer(const Json& reply) { return !at(reply, "/peer_id").is_null(); }

std::string peer_text(const Json& reply)
{
    std::string text =
        fmt::format("{} {}, started {:.2f} s ago, {}: {}\n",
                    at(reply, "/program") == "hapnet-lab" ? "hapnet-lab, peer" : "hapnet-peer",
                    text_at(reply, "/peer_id"), number_at(reply, "/elapsed_s"),
                    text_at(reply, "/state"), text_at(reply, "/says"));
    text += fmt::format(
        "task {}, scene {}, algorithm {}, seed {}, session {} s, force limit {} N\n",
        text_at(reply, "/task"), text_at(reply, "/scene"), text_at(reply, "/algorithm"),
        text_at(reply, "/seed"), text_at(reply, "/duration_s"), text_at(reply, "/force_limit_n"));
    if (at(reply, "/session").is_object()) {
        const double at_s = number_at(reply, "/session/at_s");
        const bool is_a = at(reply, "/session/role") == "L";
        text += fmt::format("session {} as {}, {:.2f} s {} its start\n",
                            text_at(reply, "/session/number"), is_a ? "A" : "B", std::abs(at_s),
                            at_s < 0.0 ? "before" : "after");
    }
    return text + fmt::format("device {}, governor {}, force {} N\n", text_at(reply, "/device"),
                              text_at(reply, "/governor"), text_at(reply, "/force_n"));
}

std::string state_text(const Json& reply)
{
    if (is_from_peer(reply)) return peer_text(reply);
    std::string text = fmt::format("# generation {}, {} s since the start, timeline at {} s",
                                   text_at(reply, "/generation"), text_at(reply, "/elapsed_s"),
                                   text_at(reply, "/timeline/position_s"));
    if (const auto next = at(reply, "/timeline/next_change_in_s"); next.is_number()) {
        text += fmt::format(", next change in {} s", text_of(next));
    }
    text += "\n";
    for (const Json& one : at(reply, "/live")) {
        const Json settings = at(one, "/settings");
        for (const auto& [key, value] : settings.items()) {
            text += fmt::format("# set by hand: {} = {}", key, text_of(value));
            if (const auto left = at(one, "/remaining_s"); left.is_number()) {
                text += fmt::format(", for {} s more", text_of(left));
            }
            text += "\n";
        }
    }
    return text + text_at(reply, "/profile");
}

std::string diff_text(const Json& reply)
{
    std::string text;
    for (const Json& one : at(reply, "/changes")) {
        text += fmt::format("{}: {} -> {}\n", text_at(one, "/key"), text_at(one, "/from"),
                            text_at(one, "/to"));
    }
    if (at(reply, "/is_other_timeline") == true) {
        const double now = number_at(reply, "/timeline/from");
        text += fmt::format("timeline: {} step{} to come, {} after apply (counted from that "
                            "moment)\n",
                            now, now == 1.0 ? "" : "s", text_at(reply, "/timeline/to"));
    }
    return text.empty() ? "nothing would change\n" : text;
}

/// The largest number of paths whose datagram numbers are printed.
constexpr std::size_t paths_told_max = 4;

/// Returns text that names the datagrams from which on the conditions apply.
std::string effect_text(const Json& reply)
{
    std::string from;
    if (at(reply, "/effective_at/up").is_number()) {
        from =
            fmt::format("datagram {} up (A to B) and datagram {} down (B to A)",
                        text_at(reply, "/effective_at/up"), text_at(reply, "/effective_at/down"));
    } else if (const Json paths = at(reply, "/effective_at"); paths.size() > paths_told_max) {
        from = fmt::format("the next datagrams of {} paths, which --json names", paths.size());
    } else {
        for (const auto& [path, next] : paths.items()) {
            from += fmt::format("{}datagram {} up and {} down of {}", from.empty() ? "" : ", ",
                                text_at(next, "/up"), text_at(next, "/down"), path);
        }
    }
    return fmt::format("generation {} holds{}{}, {:.2f} s after the start\n",
                       text_at(reply, "/generation"), from.empty() ? "" : " from ", from,
                       number_at(reply, "/elapsed_s"));
}

} // namespace

std::string in_words(const Options& options, const Json& reply)
{
    const std::string& command = options.command;
    if (command == "show") return state_text(reply);
    if (command == "diff") return diff_text(reply);
    if (command == "stats") {
        Json statistics = reply;
        statistics.erase("ok");
        if (options.as_csv) return "key,value\n" + csv_lines(statistics, "");
        return statistics.dump(2) + "\n";
    }
    if (command == "metrics") {
        output::Metrics metrics;
        metrics.add(at(reply, "/metrics"));
        return metrics.text();
    }
    if (command == "stop") {
        return text_at(reply, "/program") == "hapnet-emulator"
                   ? "the emulator ends and writes its files\n"
                   : "the peer ends with zero force\n";
    }
    if (command == "keep") return fmt::format("{}\n", text_at(reply, "/file"));
    if (command == "estop") return "zero force until the peer is started anew\n";
    if (command == "wait") {
        const auto until = text_at(reply, "/until");
        const double elapsed_s = number_at(reply, "/elapsed_s");
        if (at(reply, "/met") == true) {
            return fmt::format("{}: met {:.2f} s after the start\n", until, elapsed_s);
        }
        return fmt::format("{}: not met{} ({:.2f} s after the start)\n", until,
                           options.timeout ? " within " + base::to_text(*options.timeout) : "",
                           elapsed_s);
    }
    if (at(reply, "/changed") == false) {
        return fmt::format("nothing changed: generation {} still holds\n",
                           text_at(reply, "/generation"));
    }
    return effect_text(reply);
}

std::string WatchPrinter::next(const Json& reply)
{
    std::string text = is_terminal_ ? table(reply) : line(reply);
    last_ = reply;
    return text;
}

std::string WatchPrinter::rate(const std::string& pointer, const Json& statistics) const
{
    const double time =
        number_at(statistics, "/elapsed_s") - (last_ ? number_at(*last_, "/elapsed_s") : 0.0);
    const double count =
        number_at(statistics, pointer) - (last_ ? number_at(*last_, pointer) : 0.0);
    return time > 0.0 ? fmt::format("{:.0f}", count / time) : "-";
}

std::string WatchPrinter::table(const Json& statistics) const
{
    std::string rows;
    if (is_from_peer(statistics)) {
        rows = peer_table(statistics);
    } else {
        rows = fmt::format("{} s, generation {}\n", text_at(statistics, "/elapsed_s"),
                           text_at(statistics, "/generation"));
        rows += fmt::format("{:<5}{:>9}{:>12}{:>12}{:>12}{:>10}{:>10}{:>10}\n", "", "per s",
                            "received", "delivered", "dropped", "in flight", "p50 us", "p99 us");
        for (const char* direction : {"up", "down"}) {
            const std::string place = fmt::format("/{}", direction);
            rows += fmt::format("{:<5}{:>9}{:>12}{:>12}{:>12}{:>10}{:>10}{:>10}\n", direction,
                                rate(place + "/received", statistics),
                                text_at(statistics, place + "/received"),
                                text_at(statistics, place + "/delivered"),
                                total_of(at(statistics, place + "/dropped")),
                                text_at(statistics, place + "/in_flight"),
                                text_at(statistics, place + "/lateness_us/p50"),
                                text_at(statistics, place + "/lateness_us/p99"));
        }
    }
    // Moves the cursor back to the top of the previous table, whose lines are overwritten to their
    // ends.
    const auto lines = std::count(rows.begin(), rows.end(), '\n');
    std::string text = last_ ? fmt::format("\x1b[{}A", lines) : "";
    for (const char c : rows) text += c == '\n' ? "\x1b[K\n" : std::string{c};
    return text;
}

std::string WatchPrinter::peer_table(const Json& statistics) const
{
    return fmt::format("{} s, governor {}, fault {}\n{:>12}{:>9}{:>12}{:>12}{:>12}{:>9}\n"
                       "{:>12}{:>9}{:>12}{:>12}{:>12}{:>9}\n",
                       text_at(statistics, "/elapsed_s"), text_at(statistics, "/governor/state"),
                       text_at(statistics, "/governor/fault"), "ticks", "missed", "late p99 us",
                       "sent", "received", "per s", text_at(statistics, "/tick/count"),
                       text_at(statistics, "/tick/missed"),
                       text_at(statistics, "/tick/late_us/p99"),
                       text_at(statistics, "/messages/states_sent"),
                       text_at(statistics, "/messages/states_received"),
                       rate("/messages/states_received", statistics));
}

std::string WatchPrinter::peer_line(const Json& statistics) const
{
    return fmt::format(
        "elapsed_s={} ticks={} missed={} late_p99_us={} sent={} received={} "
        "received_per_s={} governor={} fault={}\n",
        text_at(statistics, "/elapsed_s"), text_at(statistics, "/tick/count"),
        text_at(statistics, "/tick/missed"), text_at(statistics, "/tick/late_us/p99"),
        text_at(statistics, "/messages/states_sent"),
        text_at(statistics, "/messages/states_received"),
        rate("/messages/states_received", statistics), text_at(statistics, "/governor/state"),
        text_at(statistics, "/governor/fault"));
}

std::string WatchPrinter::line(const Json& statistics) const
{
    if (is_from_peer(statistics)) return peer_line(statistics);
    std::string text = fmt::format("elapsed_s={} generation={}", text_at(statistics, "/elapsed_s"),
                                   text_at(statistics, "/generation"));
    for (const char* direction : {"up", "down"}) {
        const std::string place = fmt::format("/{}", direction);
        text += fmt::format(
            " {0}.per_s={1} {0}.received={2} {0}.delivered={3} {0}.dropped={4}"
            " {0}.in_flight={5} {0}.late_p99_us={6}",
            direction, rate(place + "/received", statistics),
            text_at(statistics, place + "/received"), text_at(statistics, place + "/delivered"),
            total_of(at(statistics, place + "/dropped")), text_at(statistics, place + "/in_flight"),
            text_at(statistics, place + "/lateness_us/p99"));
    }
    return text + "\n";
}

} // namespace hapnet::ctl
