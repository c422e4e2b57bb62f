// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/frame_options.hpp"
#include "proto/net/child_command.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// All networks but the emulator's own one, reached through pasta or slirp4netns: a process in the
/// network that the emulator came from, which does in sockets there what frames on an interface of
/// the emulator's network ask for. IPv4 alone.
class World {
public:
    // Where it has its addresses on that interface.
    static constexpr const char* address_of_command = "10.0.2.100";
    static constexpr const char* router = "10.0.2.2"; // it stands for this machine, too
    static constexpr const char* name_server = "10.0.2.3";

    /// Before the emulator enters its own network, in which the interface will be. nullopt: the
    /// first of the two that works. Throws std::system_error.
    World(std::optional<WorldProgram> only, std::string interface);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// In the emulator's own network: makes the interface. Throws std::system_error that says what
    /// kept each program from it, and what a person can do.
    void open();

    // Once it is open.
    [[nodiscard]] std::string_view name() const;
    [[nodiscard]] net::ChildCommand& process();

private:
    class Helper;

    std::string interface_;
    std::vector<std::unique_ptr<Helper>> helpers_;
    Helper* used_ = nullptr;
};

/// What a command reads as /etc/resolv.conf there: that of this machine with another name server.
[[nodiscard]] std::string name_servers_of_world();

} // namespace hapnet::emulator
