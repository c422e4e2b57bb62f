// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace hapnet::emulator::tools {

/// A question of `hapnet-emulator probe`, or its answer, which is as long as the question.
/// docs/use/probe.md describes the bytes.
struct ProbeMessage {
    bool is_answer = false;
    std::uint64_t session = 0;  // number of the asking program's session, drawn at its start
    std::uint64_t sequence = 0; // number of the question, from 0
    base::TimePoint sent{};     // departure of the question, by the asking side's clock

    // Fields of an answer, by the clock of the answering side:
    base::TimePoint received{}; // the question's kernel receive stamp
    base::TimePoint answered{};
    std::uint64_t heard = 0; // questions of this session received so far, without copies
    std::uint64_t boot = 0;  // boot of the answering machine; see boot_number()

    static constexpr std::size_t bytes_min = 72;
    static constexpr std::size_t bytes_max = 65'507; // largest UDP payload over IPv4

    friend bool operator==(const ProbeMessage&, const ProbeMessage&) = default;
};

/// Writes the message to the beginning of `bytes`, and zeros to the rest. Ensures that it has room.
void encode(const ProbeMessage& message, std::span<std::byte> bytes);

/// Reads a message. The error says why these bytes are not a message: they are another program's,
/// or damaged. A single changed byte is always detected.
[[nodiscard]] base::Result<ProbeMessage> decode_probe(std::span<const std::byte> bytes);

/// Returns a number that identifies a boot; 0 if the system does not provide its identity.
[[nodiscard]] std::uint64_t boot_number(std::string_view boot_id);

} // namespace hapnet::emulator::tools
