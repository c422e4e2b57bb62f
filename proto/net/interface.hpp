// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <sys/types.h>

namespace hapnet::net {

// Functions on the interfaces of the network namespace of the calling process. Each throws
// std::system_error naming the interface. Those that change something need CAP_NET_ADMIN there.

/// Returns the length of the longest IP packet that the interface sends, in bytes.
[[nodiscard]] std::size_t mtu_of(const std::string& interface);

[[nodiscard]] bool has_interface(const std::string& interface);

/// Creates two joined interfaces: a packet sent on one arrives at the other. The second one is in
/// the network namespace of another process, and has the hardware address `machine_there`. If that
/// is empty, the kernel chooses one.
void make_veth(const std::string& here, const std::string& there, pid_t process_there,
               std::span<const std::byte> machine_there = {});

void set_up(const std::string& interface);

/// Adds an address, "10.0.0.1" or "fd00::1", with the prefix length of its network. The address is
/// usable at once: there is no duplicate address detection.
void add_address(const std::string& interface, const std::string& address, std::uint8_t bits);

/// Routes IPv4 multicast and broadcast (255.255.255.255) to this interface.
void add_group_routes(const std::string& interface);

/// Routes packets to all other networks to this router.
void add_default_route(const std::string& interface, const std::string& router);

/// Makes the interface ignore the addresses and routes that IPv6 routers announce, as far as the
/// system allows it. Throws nothing.
void ignore_router_advertisements(const std::string& interface);

/// Switches off the work that the kernel leaves to the device: checksums, and the splitting and
/// joining of packets. Outgoing frames are then as they would be on a wire. Throws nothing: missing
/// features, and those that the interface does not give up, are ignored.
void switch_off_offloads(const std::string& interface);

/// Returns the receive offloads by which the interface joins arriving packets, encoded as one
/// number. 0: it joins none.
[[nodiscard]] std::uint32_t receive_offloads_of(const std::string& interface);
void set_receive_offloads(const std::string& interface, std::uint32_t offloads);

} // namespace hapnet::net
