// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/live.hpp"
#include "emulator/options.hpp"
#include "emulator/pacer.hpp"
#include "emulator/places.hpp"
#include "emulator/relay.hpp"
#include "emulator/report.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/stop_signal.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <unistd.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

constexpr std::string_view program = "hapnet-emulator";

void say(std::string_view text) { net::say(program, text); }

/// The status line of a terminal; nothing elsewhere.
class Status {
public:
    explicit Status(base::TimePoint now)
        : next_{isatty(STDERR_FILENO) != 0 ? std::optional{now} : std::nullopt}
    {}

    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return next_; }

    void show(const Run& run, base::TimePoint now)
    {
        if (!base::is_due(next_, now)) return;
        next_ = now + 500ms;
        net::tell(fmt::format("\r{}\x1b[K", status_line(run)));
    }

    /// Makes room for another line.
    void clear() const
    {
        if (next_) net::tell("\r\x1b[K");
    }

private:
    std::optional<base::TimePoint> next_;
};

/// Relays until told to stop.
void relay_until_stopped(Relay& relay, Live& live, Run& run, net::StopSignal& stop)
{
    const auto start = net::monotonic_now();
    std::optional<base::TimePoint> end;
    if (run.options.duration) end = start + *run.options.duration;
    const std::array descriptors{relay.a().socket.descriptor(), relay.b().socket.descriptor(),
                                 stop.descriptor(), live.descriptor()};
    Pacer pacer{run.options.timing, start};
    Status status{start};
    auto now = start;
    while (!stop.requested() && !base::is_due(end, now)) {
        pacer.wait(descriptors,
                   base::earlier(base::earlier(relay.next_deadline(), live.next_deadline()),
                                 base::earlier(end, status.next_deadline())));
        const bool adopted = relay.receive() > 0;
        now = net::monotonic_now();
        relay.release(now);
        run.elapsed = now - start;
        live.update(now);
        if (adopted) {
            status.clear();
            say(endpoints_line(relay));
        }
        status.show(run, now);
    }
    status.clear();
}

void write_statistics(const Run& run, std::optional<net::ResultFile>& file)
{
    if (file) {
        file->commit(statistics_json(run));
    } else if (run.options.stats) {
        fmt::print("{}", statistics_json(run));
    }
    net::tell(summary(run));
}

base::Result<int> emulate(const Options& options)
{
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    net::StopSignal stop;
    Relay relay{*places, options};
    std::optional<net::ResultFile> file;
    if (options.stats && *options.stats != "-") file.emplace(*options.stats);
    Run run{options, relay, net::request_real_time(40), {}};
    if (const auto shortage = run.real_time.shortage(); !shortage.empty()) say(shortage);
    Live live{{.profile = {"", options.seed, options.path, {}},
               .socket = options.control,
               .statistics_json = [&run] { return statistics_json(run); }},
              relay};
    fmt::print("{}", ready_line(options, relay));
    std::fflush(stdout);

    relay_until_stopped(relay, live, run, stop);
    write_statistics(run, file);
    return 0;
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program, parse_options(words), emulate);
}

} // namespace hapnet::emulator

int main(int argc, char** argv)
{
    return hapnet::emulator::main_program({argv, static_cast<std::size_t>(argc)});
}
