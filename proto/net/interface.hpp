// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <sys/types.h>

namespace hapnet::net {

// The network interfaces of the network namespace of the calling process. Each function throws
// std::system_error naming the interface; those that change something need CAP_NET_ADMIN there.

/// The longest IP packet that it sends, in bytes.
[[nodiscard]] std::size_t mtu_of(const std::string& interface);

[[nodiscard]] bool has_interface(const std::string& interface);

/// Makes two interfaces that are joined: what is sent on one arrives at the other. The second one
/// is made in the network namespace of another process, with this hardware address; empty: the
/// kernel makes one up.
void make_veth(const std::string& here, const std::string& there, pid_t process_there,
               std::span<const std::byte> machine_there = {});

void set_up(const std::string& interface);

/// "10.0.0.1" or "fd00::1", and the bits of its network. Usable at once: no other host is asked
/// whether it has the address.
void add_address(const std::string& interface, const std::string& address, std::uint8_t bits);

/// Sends what is for a group of IPv4 (multicast), or for all hosts (255.255.255.255), by this
/// interface.
void add_group_routes(const std::string& interface);

/// Sends what is for no known network to this router.
void add_default_route(const std::string& interface, const std::string& router);

/// Makes the interface ignore the addresses and routes that IPv6 routers announce, as far as the
/// system allows it. Throws nothing.
void ignore_router_advertisements(const std::string& interface);

/// Work that the kernel leaves to a device, off: checksums, and frames that are cut up or put
/// together there. Then what leaves is what would be on a wire. Throws nothing: features that the
/// interface does not have, or not let go of, stay.
void switch_off_offloads(const std::string& interface);

/// Returns the receive offloads by which the interface joins arriving packets, as one number; 0: it
/// joins none.
[[nodiscard]] std::uint32_t receive_offloads_of(const std::string& interface);
void set_receive_offloads(const std::string& interface, std::uint32_t offloads);

} // namespace hapnet::net
