// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// Returns a router's answer to the sender of a frame whose IP packet is longer than `mtu`: a frame
/// with ICMP's "fragmentation needed" (RFC 792, RFC 1191) or ICMPv6's "packet too big" (RFC 4443),
/// to be sent to where the packet came from. Its source address is the packet's destination, as a
/// bridge has no address of its own. Returns an empty frame where a router sends no answer: to a
/// packet that may be fragmented, to a group, from no single host, about another error, or when
/// `mtu` is less than the minimum of the address family (68 and 1280), which no sender could obey.
[[nodiscard]] std::vector<std::byte> too_big_answer(std::span<const std::byte> frame,
                                                    std::size_t mtu);

} // namespace hapnet::emulator
