// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/e2e/process.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <vector>

namespace hapnet::e2e {

/// Returns "127.0.0.1:PORT" with a port that was free a moment ago, for a program that returns
/// there.
[[nodiscard]] std::string free_place();

/// A running hapnet-peer that writes a record and statistics.
class Peer {
public:
    /// Starts it and waits until its loop runs; fails the test when it does not.
    Peer(int id, std::string listen, std::string remote, std::vector<std::string> options);

    [[nodiscard]] const std::string& listen() const { return words_[3]; }
    [[nodiscard]] Process& process() { return *process_; }

    /// True if the peer prints this within 20 s. If not, the test shows its output so far.
    [[nodiscard]] bool says(std::string_view words);

    /// Kills it with SIGKILL.
    void kill();
    /// Starts it again at the same place, as a new run with a new record.
    void restart();

    /// Waits for its end, at most 30 s; expects exit code 0.
    void expect_end();
    /// SIGTERM, and its end.
    void stop();

    /// Sends SIGTERM and waits for the end. Exit code 1 is accepted when the machine stood still
    /// and the peer therefore ends at zero force.
    void stop_on_a_busy_machine();

    /// The statistics of the newest run, after its end.
    [[nodiscard]] nlohmann::json statistics() const;
    [[nodiscard]] std::string record() const { return folder_.file("run.rec"); }

private:
    void start();

    TemporaryFolder folder_;
    std::vector<std::string> words_;
    std::optional<Process> process_;
};

/// Returns a running peer's answer to a command on its control socket.
[[nodiscard]] nlohmann::json answer_of(const std::string& socket, const std::string& command);

/// Expects a running peer to receive `count` messages, so that its record is worth replaying.
void expect_to_hear(const std::string& socket, int messages);

/// The fault that holds the device of a running peer at zero force, as its control socket names it:
/// "none", or "timeout" when the machine stood still.
[[nodiscard]] std::string fault_at(const std::string& socket);

/// Acts like a person who cannot feel the cube, 60 s at most. While a peer at one of these sockets
/// is at zero force for a fault, it holds the device still for the required second, and presses the
/// button until the fault is over. Without a fault it reaches out further, as the cube may have
/// been pushed away. Returns whether the cube was felt.
template <typename Felt, typename Press, typename Reach>
[[nodiscard]] bool comes_to_be_felt(const std::vector<std::string>& sockets, Felt felt, Press press,
                                    Reach reach)
{
    using namespace std::chrono_literals;
    const auto is_at_zero = [&] {
        return std::any_of(sockets.begin(), sockets.end(),
                           [](const std::string& socket) { return fault_at(socket) != "none"; });
    };
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!comes_true(felt, 1s)) {
        if (std::chrono::steady_clock::now() > end) return false;
        if (!is_at_zero()) {
            reach();
            continue;
        }
        std::this_thread::sleep_for(1200ms);
        press(true);
        std::ignore = comes_true([&] { return felt() || !is_at_zero(); }, 1s);
        press(false);
    }
    return true;
}

/// The columns of a record's tick that these tests use.
struct Tick {
    double time_s = 0.0; // from the start of the session
    std::string phase;
    bool remote_fresh = false;
    double force_n = 0.0; // force given to the device
    std::array<double, 3> hip_mm{};
    bool docked = false;
};

/// The ticks of a record, by `hapnet-lab export`.
[[nodiscard]] std::vector<Tick> ticks_of(const std::string& record);

/// Replays a record with `hapnet-lab replay`. Expects the recorded forces, to 1e-9 N. Returns the
/// output of --json.
nlohmann::json expect_the_same_forces_again(const std::string& record);

/// Returns the output of `hapnet-lab analyse --json` for two records.
[[nodiscard]] nlohmann::json analysis_of(const std::string& record_a, const std::string& record_b);

} // namespace hapnet::e2e
