// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/emulator/control/emulation_fake.hpp"

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <string_view>

namespace {

using namespace hapnet;
using namespace hapnet::emulator;

const base::TimePoint start{};

/// True if a profile names files. They came with the request, and cannot be read again.
bool names_files(const std::string& profile) { return profile.find("file =") != std::string::npos; }

/// Says the text to the emulator, and looks at the answers.
void say(const std::string& text, EmulationFake& fake)
{
    Conversation conversation;
    conversation.on_bytes(std::string_view{text}.substr(0, conversation.room()));
    conversation.on_end();
    std::string said;
    while (conversation.advance(fake.subject, start)) said += said_by(conversation, start);
    std::istringstream lines{said};
    for (std::string line; std::getline(lines, line);) {
        const auto reply = nlohmann::json::parse(line, nullptr, false);
        base::ensure(reply.is_object() && reply.contains("ok") && reply["ok"].is_boolean());
        if (!reply.contains("profile")) continue;
        const std::string shown = reply["profile"];
        if (names_files(shown)) continue;
        base::ensure(parse_profile(shown, "shown", EmulationFake::no_files).has_value());
    }
}

} // namespace

/// Every line of an answer to any client of the control socket is an object that says whether the
/// request succeeded. The profile shown in the end reads back. This holds for one path, for links
/// and for clients.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const std::string_view profile = "[both]\ndelay = \"160ms\"\n";
    EmulationFake fake{profile, start};
    say(text, fake);
    const Profile shown = fake.director().remaining();
    const std::string written = to_text(shown);
    base::ensure(names_files(written) ||
                 parse_profile(written, "shown", EmulationFake::no_files).value() == shown);
    EmulationFake links{profile, start, {"1-2", "wan"}};
    say(text, links);
    EmulationFake clients{profile, start, {"client.1"}, true};
    say(text, clients);
    return 0;
}
