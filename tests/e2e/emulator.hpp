// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/endpoint.hpp"
#include "proto/net/unix_socket.hpp"
#include "tests/e2e/process.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::e2e {

/// A running emulator on free loopback ports that writes its statistics to a file.
class Emulator {
public:
    /// Starts it and waits until it listens; fails the test when it does not. `host` is what both
    /// sides listen on, with port 0.
    explicit Emulator(const std::vector<std::string>& options,
                      std::string_view host = "127.0.0.1:0");

    /// The addresses to which A and B send.
    [[nodiscard]] const net::Endpoint& a() const { return *a_; }
    [[nodiscard]] const net::Endpoint& b() const { return *b_; }

    [[nodiscard]] Process& process() { return *process_; }

    /// Ends it with `signal_number` and reads what it wrote; expects exit code 0, and the
    /// accounting identity in both directions.
    [[nodiscard]] nlohmann::json stop(int signal_number);
    [[nodiscard]] nlohmann::json stop();

private:
    TemporaryFolder folder_;
    std::optional<Process> process_;
    std::optional<net::Endpoint> a_;
    std::optional<net::Endpoint> b_;
};

/// Returns the answer on a program's control socket to a client that sends `text`: a line, or all
/// that came until the connection was closed.
[[nodiscard]] std::string said_by(const std::string& socket, std::string_view text);
/// Returns the answer to a client's earlier text; nothing after 5 s of silence.
[[nodiscard]] std::string heard(net::UnixStream& stream);

/// Expects received + duplicated = delivered + dropped + in_flight in one direction's statistics.
void expect_identity(const nlohmann::json& direction);

} // namespace hapnet::e2e
