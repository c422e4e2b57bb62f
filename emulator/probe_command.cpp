// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/tools/probe_answerer.hpp"
#include "emulator/tools/probe_message.hpp"
#include "emulator/tools/probe_statistics.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

double probe_ms(base::Duration duration) { return 1e3 * base::to_seconds(duration); }

net::Endpoint any_of(int family)
{
    return net::resolve({family == AF_INET6 ? "::" : "0.0.0.0", 0});
}

std::string line_of(const char* name, const std::optional<tools::ProbeDelays>& delays)
{
    if (!delays) return "";
    return fmt::format("{:<18}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}\n", name,
                       probe_ms(delays->min), probe_ms(delays->mean), probe_ms(delays->p50),
                       probe_ms(delays->p99), probe_ms(delays->max));
}

std::string losses_in_words(const tools::ProbeSummary& of)
{
    const auto lost = of.sent - of.answered;
    if (lost == 0 || of.answered == 0) return "";
    auto text = fmt::format(" ({} there, {} back", of.there.lost, of.back.lost);
    if (of.unknown > 0) text += fmt::format(", {} after the last answer", of.unknown);
    return text + ")";
}

std::string words_of(const tools::ProbeSummary& of, const net::Endpoint& target)
{
    auto text =
        fmt::format("--- {} probe statistics ---\n{} sent, {} answered, {:.3g}% lost{}",
                    target.to_text(), of.sent, of.answered, 100.0 * of.loss(), losses_in_words(of));
    if (of.copies > 0) text += fmt::format(", {} copies", of.copies);
    if (of.reordered > 0) text += fmt::format(", {} reordered", of.reordered);
    text += "\n";
    if (of.answered == 0) return text;
    text += fmt::format("{:<18}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "ms", "min", "mean", "p50", "p99",
                        "max");
    text += line_of("round trip", of.round_trip.delay) + line_of("there", of.there.delay) +
            line_of("back", of.back.delay) + line_of("|IPDV| round trip", of.round_trip.ipdv) +
            line_of("|IPDV| there", of.there.ipdv) + line_of("|IPDV| back", of.back.ipdv);
    if (!of.clocks_are_one) {
        text += "The ends have two clocks: the delay of one way by itself is not known.\n";
    }
    return text;
}

/// The end that sends questions.
class Prober {
public:
    explicit Prober(const ProbeOptions& options)
        : options_{options},
          target_{net::resolve(*options.target)},
          socket_{any_of(target_.family())},
          statistics_{net::unpredictable_bits(), tools::boot_number(net::boot_id())},
          bytes_(options.bytes)
    {
        net::require_route(target_);
        if (options.csv) csv_.emplace(*options.csv, "--csv");
    }

    void ask_until_stopped(const net::StopSignal& stop)
    {
        const std::array descriptors{socket_.descriptor(), stop.descriptor()};
        next_ = net::monotonic_now();
        while (!stop.requested()) {
            const auto now = net::monotonic_now();
            if (has_more() && now >= next_) {
                ask();
                next_ += options_.spacing;
            }
            if (!has_more() && (statistics_.all_answered() || now >= patience_ends())) break;
            net::wait_readable(descriptors, has_more() ? next_ : patience_ends());
            take_answers();
        }
    }

    int finish()
    {
        const auto summary = statistics_.summary();
        if (options_.as_json) {
            const tools::ProbeReport report{
                .version = base::version(), .target = target_.to_text(), .summary = summary};
            fmt::print("{}\n", base::json_of(report).dump(2));
        } else {
            fmt::print("{}", words_of(summary, target_));
        }
        if (csv_) csv_->commit(statistics_.csv());
        if (summary.answered > 0) return 0;
        net::say("hapnet-emulator",
                 fmt::format("no answer from {}: does 'hapnet-emulator probe --answer ADDRESS' run "
                             "there, and do the emulator and the firewalls in between let it pass?",
                             target_.to_text()));
        return net::exit_failed;
    }

private:
    [[nodiscard]] bool has_more() const { return statistics_.sent() < options_.count; }

    [[nodiscard]] base::TimePoint patience_ends() const
    {
        constexpr base::Duration least = 200ms;
        const auto longest = statistics_.longest_round_trip();
        const bool has_answers = longest > base::Duration{0};
        return last_ + (has_answers ? std::min(options_.wait, std::max(2 * longest, least))
                                    : options_.wait);
    }

    void ask()
    {
        last_ = net::monotonic_now();
        encode(statistics_.next_question(last_), bytes_);
        const auto outcome = socket_.send(target_, bytes_);
        if (outcome == net::SendOutcome::sent || has_told_) return;
        has_told_ = true; // reported only once; the question counts as lost
        net::say("hapnet-emulator", outcome == net::SendOutcome::too_big
                                        ? "a question is too big for the way: lower --size"
                                        : "the system did not take a question; it counts as lost");
    }

    void take_answers()
    {
        for (const net::Received& datagram : socket_.receive()) {
            const auto message = tools::decode_probe(datagram.bytes);
            if (!message) continue;
            const auto reply = statistics_.on_answer(*message, datagram.at);
            if (!reply || options_.is_quiet || options_.as_json) continue;
            fmt::print("{} bytes from {}: seq={} time={:.3f} ms", datagram.bytes.size(),
                       datagram.from.to_text(), reply->sequence, probe_ms(reply->round_trip));
            if (statistics_.clocks_are_one()) {
                fmt::print(" (there {:.3f}, back {:.3f})", probe_ms(reply->there),
                           probe_ms(reply->back));
            }
            net::print_now(reply->is_copy ? " (copy)\n" : "\n");
        }
    }

    const ProbeOptions& options_;
    net::Endpoint target_;
    net::UdpSocket socket_;
    tools::ProbeStatistics statistics_;
    std::vector<std::byte> bytes_;
    std::optional<disk::ResultFile> csv_;
    base::TimePoint next_{};
    base::TimePoint last_{};
    bool has_told_ = false;
};

int answer_until_stopped(const net::HostPort& where, const net::StopSignal& stop)
{
    net::UdpSocket socket{net::resolve(where), net::Load::bulk};
    tools::ProbeAnswerer answerer{tools::boot_number(net::boot_id())};
    net::print_now(fmt::format("ready answer={}\n", socket.local().to_text()));
    const std::array descriptors{socket.descriptor(), stop.descriptor()};
    std::vector<std::byte> bytes(tools::ProbeMessage::bytes_max);
    while (!stop.requested()) {
        net::wait_readable(descriptors, std::nullopt);
        for (const net::Received& datagram : socket.receive()) {
            const auto question = tools::decode_probe(datagram.bytes);
            auto answer = question ? answerer.answer(*question, datagram.at) : std::nullopt;
            if (!answer) continue;
            // An answer is never longer than the question, so an attacker gains nothing by giving a
            // victim's address as the sender.
            const auto room = std::span{bytes}.first(std::min(datagram.bytes.size(), bytes.size()));
            answer->answered = net::monotonic_now();
            encode(*answer, room);
            std::ignore = socket.send(datagram.from, room); // an answer that cannot be sent is lost
        }
    }
    return 0;
}

} // namespace

base::Result<int> run(const ProbeOptions& options)
{
    const net::StopSignal stop{net::Hangup::stop};
    if (options.answer) return answer_until_stopped(*options.answer, stop);
    Prober prober{options};
    prober.ask_until_stopped(stop);
    return prober.finish();
}

} // namespace hapnet::emulator
