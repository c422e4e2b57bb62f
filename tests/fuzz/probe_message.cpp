// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_message.hpp"
#include "emulator/tools/probe_statistics.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <vector>

/// A message that decode_probe() accepts comes back the same when it is written again, and its
/// times can be counted with.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    using namespace hapnet::emulator::tools;
    const auto message = decode_probe(fuzz::bytes_of(data, size));
    if (!message) return 0;
    std::vector<std::byte> again(size);
    encode(*message, again);
    base::ensure(decode_probe(again) == *message);
    ProbeStatistics statistics{message->session, message->boot};
    std::ignore = statistics.next_question(message->sent);
    std::ignore = statistics.on_answer(*message, message->sent);
    base::ensure(statistics.summary().sent == 1);
    return 0;
}
