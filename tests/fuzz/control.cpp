// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/emulator/control/emulation_fake.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

/// Whatever a client of the control socket sends, each line of the answers is an object that says
/// whether it is one of success, and the profile that is shown in the end reads back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    using namespace hapnet::emulator;
    const base::TimePoint start{};
    EmulationFake fake{"[both]\ndelay = \"160ms\"\n", start};
    Conversation conversation;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    text.resize(std::min(text.size(), conversation.room()));
    conversation.on_bytes(text);
    conversation.on_end();
    std::string said;
    while (conversation.advance(fake.subject, start)) said += said_by(conversation, start);
    std::istringstream lines{said};
    for (std::string line; std::getline(lines, line);) {
        const auto reply = nlohmann::json::parse(line, nullptr, false);
        base::ensure(reply.is_object() && reply.contains("ok") && reply["ok"].is_boolean());
    }
    const Profile shown = fake.director().remaining();
    base::ensure(parse_profile(to_text(shown), "shown", EmulationFake::no_files).value() == shown);
    return 0;
}
