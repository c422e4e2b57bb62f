// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/frame.hpp"
#include "emulator/frame_session.hpp"
#include "proto/net/child_command.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The end of the emulated wire at a command that has a network of its own: the interface eth0.
struct WireEnd {
    struct Address {
        std::string text; // "10.0.0.1"
        std::uint8_t bits = 24;
    };

    std::string wire; // the emulator's interface to it
    std::vector<Address> addresses;
    // The address of the router to all other networks; "": there is none.
    std::string router{};
    std::string router_v6{};
    std::optional<MacAddress> machine{}; // MAC of eth0; nullopt: the kernel draws one
};

/// Sets up eth0 for the command. Use it as net::ChildCommand::Setup::prepare.
void prepare(const WireEnd& end);

/// Makes the wire to the command, and lets the command prepare its end. Call it in the emulator's
/// network.
void connect(net::ChildCommand& command, const WireEnd& end);

/// Opens a session between two interfaces of the emulator's own network. Throws a std::system_error
/// that names the remedy if the system refuses their frames.
[[nodiscard]] std::unique_ptr<FrameSession>
open_session(const Options& options, const Scenario& scenario, const FrameSession::Setup& setup);

} // namespace hapnet::emulator
