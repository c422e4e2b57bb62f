// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Lines of all kinds to the control socket of an emulator with 64 clients: measures the time that
// the relaying thread spends on each line. This thread relays in between, as in the program.
#include "emulator/control/request.hpp"
#include "emulator/control_desk.hpp"
#include "emulator/core/all_paths.hpp"
#include "emulator/paths_report.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/run_state.hpp"
#include "emulator/scenario.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/unix_socket.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

constexpr std::size_t clients_count = 64;
constexpr base::Duration turn_max = 100us;

base::Duration own_processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

net::Endpoint loopback() { return net::resolve({.host = "127.0.0.1", .port = 0}); }

net::AddressSet this_machine()
{
    net::AddressSet set;
    set.add_host(loopback());
    return set;
}

std::string apply_of(const std::string& profile)
{
    return Json{{"command", "apply"}, {"profile", profile}}.dump();
}

std::string set_of(const std::string& key, const std::string& value)
{
    return Json{{"command", "set"}, {"settings", {{key, value}}}}.dump();
}

/// Typical requests, and the longest and most complex ones that are allowed.
std::vector<std::string> seeds()
{
    std::vector<std::string> lines;
    for (const char* command : {"show", "stats", "reset"}) {
        lines.push_back(Json{{"command", command}}.dump());
    }
    lines.push_back(set_of("both.delay", "80ms"));
    lines.push_back(set_of("up.delay", "{ law = \"normal\", mean = \"40ms\", sd = \"5ms\" }"));
    lines.push_back(set_of("client.3.loss", "10%"));
    lines.push_back(R"({"command":"set","settings":{"both.loss":"5%"},"for":"50ms"})");
    lines.push_back(R"({"command":"wait","until":"up.received>1","timeout":"1ms"})");
    lines.push_back(R"({"command":"diff","preset":"lte"})");
    lines.push_back(R"({"command":"apply","preset":"wifi-busy"})");
    lines.push_back(R"({"command":"apply","netem":"delay 100ms 20ms loss 1%"})");
    Json many{{"command", "set"}, {"settings", Json::object()}};
    for (std::size_t i = 1; i < settings_max; ++i) {
        many["settings"][fmt::format("client.{}.up.delay", i)] = fmt::format("{}ms", i);
    }
    lines.push_back(many.dump());
    std::string pattern;
    for (int i = 0; i < 900'000; ++i) pattern += i % 7 == 0 ? '1' : '0';
    lines.push_back(set_of("both.loss", "{ law = \"pattern\", pattern = \"" + pattern + "\" }"));
    std::string list = "0";
    for (int i = 1; i < 120'000; ++i) list += fmt::format(",{}", i * 3);
    lines.push_back(set_of("up.loss", "{ law = \"list\", numbers = [" + list + "] }"));
    std::string windows = R"(["0s","1ms"])";
    for (int i = 1; i < 30'000; ++i)
        windows += fmt::format(R"(,["{}ms","{}ms"])", 2 * i, 2 * i + 1);
    lines.push_back(set_of("down.loss", "{ law = \"outage\", windows = [" + windows + "] }"));
    std::string steps;
    for (int i = 0; i < 9'000; ++i) {
        steps += fmt::format("[[at]]\ntime = \"{}ms\"\nboth.delay = \"{}ms\"\n", 10 * i, i % 50);
    }
    lines.push_back(apply_of(steps));
    std::string own;
    for (std::size_t i = 1; i <= clients_count; ++i) {
        own += fmt::format("[client.{}]\nup.delay = \"{}ms\"\ndown.loss = \"{}%\"\n", i, i, i % 9);
    }
    lines.push_back(apply_of(own));
    std::string delays;
    for (int i = 0; i < 120'000; ++i) delays += fmt::format("{}ms\n", i % 90);
    Json traced{{"command", "apply"},
                {"profile", "both.delay = { law = \"trace\", file = \"d\" }"}};
    traced["files"]["d"] = delays;
    lines.push_back(traced.dump());
    std::string keys = "{";
    for (int i = 0; i < 90'000; ++i) keys += fmt::format("\"{}\":1,", i);
    lines.push_back(keys + R"("command":"stats"})");
    lines.push_back(std::string(500'000, '[') + std::string(500'000, ']'));
    return lines;
}

/// A line with some bytes changed, left out, repeated or put in from another.
std::string mutated(const std::vector<std::string>& all, std::mt19937_64& random)
{
    const auto below = [&](std::size_t bound) { return bound == 0 ? 0 : random() % bound; };
    // The control desk needs a second to read a long line, so there are few.
    constexpr std::size_t long_bytes = 10'000;
    constexpr std::size_t one_in = 500;
    const bool may_be_long = below(one_in) == 0;
    std::string line;
    do {
        line = all[below(all.size())];
    } while (line.size() > long_bytes && !may_be_long);
    for (auto changes = below(4); changes > 0 && !line.empty(); --changes) {
        const auto at = below(line.size());
        const auto length = std::min(line.size() - at, 1 + below(16));
        switch (below(5)) {
        case 0: line[at] = static_cast<char>(' ' + below(95)); break;
        case 1: line.erase(at, length); break;
        case 2: line.insert(at, line.substr(at, length)); break;
        case 3: line[at] = static_cast<char>('0' + below(10)); break;
        default: {
            const std::string& other = all[below(all.size())];
            line.insert(at, other, below(other.size()), 1 + below(40));
        }
        }
    }
    std::ranges::replace(line, '\n', ' ');
    return line;
}

/// The parts of an emulator that its control needs.
class Relay {
public:
    explicit Relay(const std::string& socket)
    {
        options_.control = socket;
        for (auto& client : clients_) client.emplace(loopback());
        desk_.emplace(ControlDesk::Setup{.socket = socket,
                                         .emulation = {.paths = run_.paths,
                                                       .statistics =
                                                           [this](const control::DoWork& work) {
                                                               look_at(run_, port_, work, state_);
                                                               return statistics_of(run_, state_);
                                                           },
                                                       .stop = [] {},
                                                       .preset = preset_text,
                                                       .netem = netem_profile}});
    }

    /// Runs until it is told to end. Each client sends a datagram every 10 ms.
    void run()
    {
        desk_->begin();
        auto next_send = net::monotonic_now();
        std::size_t client = 0;
        auto& part = *port_.parts().front();
        auto descriptors = part.descriptors();
        descriptors.push_back(desk_->turns().descriptor());
        while (!is_ending.load()) {
            auto deadline = base::earlier(paths_.front()->next_due(), next_send);
            deadline = base::earlier(deadline, desk_->turns().next_deadline());
            deadline = base::earlier(deadline, paths_.front()->next_change());
            net::wait_readable(descriptors, deadline);
            part.receive();
            const auto now = net::monotonic_now();
            paths_.front()->advance(now);
            part.release(now);
            run_.elapsed = now - start_;
            if (base::is_due(next_send, now)) {
                const std::array<std::byte, 32> datagram{};
                std::ignore = clients_[client++ % clients_.size()]->send(port_.local(), datagram);
                next_send += 10ms / clients_.size();
            }
            if (!desk_->turns().is_due(now, paths_.front()->next_due())) continue;
            const auto before = own_processor_time();
            desk_->turns().take(now);
            const auto spent = own_processor_time() - before;
            spent_ns.fetch_add(spent.count());
            turns.fetch_add(1);
            longest_ns.store(std::max(longest_ns.load(), spent.count()));
        }
        desk_->close();
    }

    std::atomic<bool> is_ending{false};
    std::atomic<std::int64_t> spent_ns{0};
    std::atomic<std::int64_t> longest_ns{0}; // longest work between two rounds
    std::atomic<std::int64_t> turns{0};

private:
    static std::vector<std::unique_ptr<Paths>> paths_of(base::TimePoint start)
    {
        std::vector<std::unique_ptr<Paths>> paths;
        paths.push_back(std::make_unique<Paths>(
            Profile{}, Paths::Setup{.start = start,
                                    .limits = QueueLimits::shared(64 << 20, clients_count),
                                    .slab = std::make_shared<Slab>(64 << 20),
                                    .takes_newcomers = true,
                                    .changes_max = 20}));
        return paths;
    }

    base::TimePoint start_ = net::monotonic_now();
    Options options_;
    Scenario scenario_;
    Recorder recorder_{{}};
    std::vector<std::unique_ptr<Paths>> paths_ = paths_of(start_);
    net::UdpSocket server_{loopback()};
    ports::Upstream port_{{loopback(), server_.local(), this_machine()},
                          {.clients_max = clients_count},
                          paths_,
                          recorder_};
    UpstreamRun run_{{options_, scenario_, *paths_.front(), recorder_}, port_};
    RunState state_;
    std::array<std::optional<net::UdpSocket>, clients_count> clients_;
    std::optional<ControlDesk> desk_;
};

/// Sends a line and waits for its answer; false when the socket was closed.
bool exchange(net::UnixStream& stream, const std::string& line)
{
    std::string rest = line + "\n";
    std::array<char, 65536> buffer{};
    for (;;) {
        if (!rest.empty()) {
            const auto sent = stream.write(rest);
            if (sent.state == net::Transfer::State::moved) rest.erase(0, sent.bytes);
            if (sent.state == net::Transfer::State::gone) return false;
        }
        const auto taken = stream.read(buffer);
        if (taken.state == net::Transfer::State::moved) {
            const std::string_view text{buffer.data(), taken.bytes};
            if (text.ends_with('\n')) return true;
        } else if (taken.state != net::Transfer::State::later) {
            return false;
        } else {
            const std::array descriptors{stream.descriptor()};
            net::wait_readable(descriptors,
                               net::monotonic_now() + (rest.empty() ? 1s : base::Duration{20us}));
        }
    }
}

struct Worst {
    std::int64_t ns = 0;
    std::string line;
};

int soak(std::uint64_t lines, std::uint64_t seed)
{
    const auto socket =
        (std::filesystem::temp_directory_path() / fmt::format("hapnet-control-soak-{}", getpid()))
            .string();
    Relay relay{socket};
    Worst turn;
    Worst whole;
    std::uint64_t broken = 0;
    std::thread client{[&] {
        net::sleep_until(net::monotonic_now() + 300ms); // until all clients have come
        std::mt19937_64 random{seed};
        const auto all = seeds();
        auto stream = net::UnixStream::connect(socket);
        for (std::uint64_t i = 0; i < lines; ++i) {
            const std::string line = i < all.size() ? all[i] : mutated(all, random);
            const auto before = relay.spent_ns.load();
            const auto turns = relay.turns.load();
            relay.longest_ns.store(0);
            if (!exchange(stream, line)) {
                ++broken;
                stream = net::UnixStream::connect(socket);
            }
            const auto spent = relay.spent_ns.load() - before;
            const auto longest = relay.longest_ns.load();
            if (i < all.size()) {
                fmt::print("  {:8.1f} us in {:3} turns, the longest {:6.1f} us, {:8} bytes: {}\n",
                           static_cast<double>(spent) / 1e3, relay.turns.load() - turns,
                           static_cast<double>(longest) / 1e3, line.size(), line.substr(0, 60));
            }
            if (longest > turn.ns) turn = {longest, line.substr(0, 200)};
            if (spent > whole.ns) whole = {spent, line.substr(0, 200)};
        }
        relay.is_ending.store(true);
    }};
    relay.run();
    client.join();
    fmt::print("  {} lines from seed {}, {} clients\n"
               "  longest turn of the relay: {:.1f} us of processor time, at {}\n"
               "  most for a line: {:.1f} us, at {}\n  connections closed: {}\n",
               lines, seed, clients_count, static_cast<double>(turn.ns) / 1e3, turn.line,
               static_cast<double>(whole.ns) / 1e3, whole.line, broken);
    return turn.ns <= turn_max.count() ? 0 : 1;
}

} // namespace
} // namespace hapnet::emulator

int main(int argc, char** argv)
{
    const std::span words{argv, static_cast<std::size_t>(argc)};
    std::array<std::uint64_t, 2> numbers{100'000, 1}; // lines, seed
    for (std::size_t i = 0; i < numbers.size() && i + 1 < words.size(); ++i) {
        const std::string_view word{words[i + 1]};
        std::from_chars(word.data(), word.data() + word.size(), numbers[i]);
    }
    return hapnet::emulator::soak(numbers[0], numbers[1]);
}
