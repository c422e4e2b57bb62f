// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/classifier.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <vector>

/// Any frame is classified, and the facts of its packet are in its bytes. A frame that is not
/// understood belongs to no flow, and bytes behind the packet change nothing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const auto bytes = fuzz::bytes_of(data, size);
    const auto frame = emulator::read_frame(bytes);
    const auto facts = emulator::facts_of(frame, bytes);
    if (!facts) return 0;
    base::ensure(facts->bytes + frame.header_bytes <= size);
    base::ensure(facts->version != 0 || facts->protocol == emulator::PacketFacts::arp);
    using emulator::Match;
    using emulator::NumberRange;
    const std::vector<Match> matches{{.protocol = facts->protocol, .port = NumberRange{0, 1023}},
                                     {.to_port = NumberRange{facts->to_port, facts->to_port}},
                                     {.protocol = facts->protocol}};
    emulator::Classifier classifier{std::make_shared<const emulator::FlowFilters>(matches)};
    const auto flow = classifier.classify(*facts, {});
    base::ensure(flow.has_value() && *flow <= 2);
    base::ensure(*flow == 2 || facts->has_ports);
    std::vector<std::byte> longer(bytes.begin(), bytes.end());
    longer.resize(size + 7);
    const auto again = emulator::facts_of(emulator::read_frame(longer), longer);
    base::ensure(again && again->to_port == facts->to_port && again->bytes == facts->bytes);
    return 0;
}
