// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/frame.hpp"
#include "emulator/frame_options.hpp"
#include "proto/net/child_command.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The connection of the emulator's own network to all others, through pasta or slirp4netns. That
/// program runs in the network from which the emulator was started. It uses sockets there to carry
/// the traffic of the frames on an interface of the emulator's network.
class World {
public:
    /// The MAC address of the command's eth0.
    static constexpr MacAddress machine_of_command{std::byte{2}, {}, {}, {}, {}, std::byte{1}};
    // The addresses of the command on that interface, of its routers and of its name server. The
    // routers also represent this machine.
    static constexpr const char* address_of_command = "10.0.2.100";
    static constexpr const char* router = "10.0.2.2";
    static constexpr const char* name_server = "10.0.2.3";
    static constexpr const char* address_of_command_v6 = "fd00::100";
    static constexpr const char* router_v6 = "fd00::2";

    /// Construct it before the emulator enters its own network, in which the interface will be.
    /// `only`: the program to use; nullopt: the first of the two programs that works. Throws
    /// std::system_error.
    World(std::optional<WorldProgram> only, std::string interface);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// Makes the interface in the emulator's own network, and returns when the program answers
    /// there. Throws a std::system_error that says why each program failed, and what a person can
    /// do.
    void open();

    /// True if the connection carries IPv6, too: this machine has a route for it.
    [[nodiscard]] bool has_ipv6() const { return has_ipv6_; }

    // Call these only after open().
    [[nodiscard]] std::string_view name() const;
    [[nodiscard]] net::ChildCommand& process();

private:
    class Helper;

    std::string interface_;
    bool has_ipv6_;
    std::vector<std::unique_ptr<Helper>> helpers_;
    Helper* used_ = nullptr;
};

/// Returns the text that a command reads as /etc/resolv.conf there: that of this machine with
/// another name server.
[[nodiscard]] std::string name_servers_of_world();

} // namespace hapnet::emulator
