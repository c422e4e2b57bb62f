// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_message.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::emulator::tools {

namespace {

constexpr std::uint32_t probe_magic = 0x42'50'4e'48; // "HNPB"
constexpr std::uint8_t probe_version = 1;
constexpr std::size_t checksum_at = 8;
constexpr std::size_t checksum_end = 16;

/// FNV-1a. Each of its steps is a bijection of the previous sum, so changing one byte changes the
/// sum.
class Checksum {
public:
    void add(std::span<const std::byte> bytes)
    {
        for (const std::byte byte : bytes) {
            sum_ = (sum_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100'0000'01b3U;
        }
    }
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    std::uint64_t sum_ = 0xcbf2'9ce4'8422'2325U;
};

/// Returns the checksum of all bytes but its own.
std::uint64_t checksum_of(std::span<const std::byte> bytes)
{
    Checksum checksum;
    checksum.add(bytes.first(checksum_at));
    checksum.add(bytes.subspan(checksum_end));
    return checksum.sum();
}

base::TimePoint time_of(std::int64_t nanoseconds)
{
    return base::TimePoint{base::Duration{nanoseconds}};
}

std::int64_t number_of(base::TimePoint time) { return time.time_since_epoch().count(); }

/// True for a time that a clock since boot can show. Sums of such times do not overflow.
bool is_sane(base::TimePoint time)
{
    constexpr std::int64_t centuries = std::int64_t{1} << 61;
    return number_of(time) >= 0 && number_of(time) < centuries;
}

} // namespace

void encode(const ProbeMessage& message, std::span<std::byte> bytes)
{
    base::ensure(bytes.size() >= ProbeMessage::bytes_min);
    std::ranges::fill(bytes, std::byte{0});
    base::ByteWriter out{bytes};
    out.u32(probe_magic);
    out.u8(probe_version);
    out.u8(message.is_answer ? 1 : 0);
    out.u16(0);
    out.u64(0); // place of the checksum
    out.u64(message.session);
    out.u64(message.sequence);
    out.i64(number_of(message.sent));
    out.i64(number_of(message.received));
    out.i64(number_of(message.answered));
    out.u64(message.heard);
    out.u64(message.boot);
    base::ByteWriter{bytes.subspan(checksum_at)}.u64(checksum_of(bytes));
}

base::Result<ProbeMessage> decode_probe(std::span<const std::byte> bytes)
{
    base::ByteReader in{bytes};
    if (in.u32() != probe_magic) return base::fail("not a datagram of a probe");
    if (in.u8() != probe_version) return base::fail("another version of the probe");
    const auto kind = in.u8();
    const auto reserved = in.u16();
    const auto checksum = in.u64();
    ProbeMessage message{.is_answer = kind == 1, .session = in.u64(), .sequence = in.u64()};
    message.sent = time_of(in.i64());
    message.received = time_of(in.i64());
    message.answered = time_of(in.i64());
    message.heard = in.u64();
    message.boot = in.u64();
    if (!in.ok()) return base::fail("cut off");
    if (checksum != checksum_of(bytes)) return base::fail("damaged");
    const bool is_canonical = kind <= 1 && reserved == 0;
    if (!is_canonical || !is_sane(message.sent) || !is_sane(message.received) ||
        !is_sane(message.answered)) {
        return base::fail("impossible values");
    }
    return message;
}

std::uint64_t boot_number(std::string_view boot_id)
{
    if (boot_id.empty()) return 0;
    Checksum checksum;
    checksum.add(std::as_bytes(std::span{boot_id}));
    return checksum.sum();
}

} // namespace hapnet::emulator::tools
