// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/emulator/control/emulation_fake.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

struct FilesOfRequests : testing::Test {
    json ask(const json& request)
    {
        return json::parse(said_to(conversation, request.dump() + "\n", fake, base::TimePoint{}));
    }
    std::string refusal_of(const json& request)
    {
        const json reply = ask(request);
        EXPECT_EQ(reply["ok"], false) << reply;
        EXPECT_EQ(fake.director().generation(), 1U);
        return reply.value("error", "");
    }

    EmulationFake fake{"", base::TimePoint{}};
    Conversation conversation{request_bytes_max};
};

json traced(const std::string& file)
{
    return {{"command", "apply"},
            {"profile", "both.delay = { law = \"trace\", file = \"" + file + "\" }"}};
}

TEST_F(FilesOfRequests, AreNotReadWhereNoFolderWasNamed)
{
    for (const char* law : {"trace", "table"}) {
        const json set{
            {"command", "set"},
            {"settings",
             {{"up.delay", std::string{"{ law = \""} + law + "\", file = \"/etc/passwd\" }"}}}};
        const auto error = refusal_of(set);
        EXPECT_NE(error.find("'/etc/passwd' was not sent"), std::string::npos) << error;
        EXPECT_EQ(error.find("root"), std::string::npos) << error;
    }
    EXPECT_NE(refusal_of(traced("/etc/passwd")).find("--files DIR"), std::string::npos);
}

TEST_F(FilesOfRequests, ComeWithThem)
{
    json request = traced("delays.csv");
    request["files"] = {{"delays.csv", "10ms\n20ms\n30ms\n"}};
    EXPECT_EQ(ask(request)["ok"], true);
    EXPECT_EQ(std::get<TraceLaw>(fake.delay(Direction::up)).trace->delays().size(), 3U);
}

TEST_F(FilesOfRequests, AreNoneOfTheFolderOnceARequestBringsItsOwn)
{
    fake.emulation.folder = [](const std::string&) { return std::string{"10ms\n"}; };
    json request = traced("delays.csv");
    request["files"] = json::object();
    EXPECT_NE(refusal_of(request).find("does not bring the file 'delays.csv'"), std::string::npos);
    request.erase("files");
    EXPECT_EQ(ask(request)["ok"], true);
}

TEST_F(FilesOfRequests, OfTheFolderAreQuotedNowhere)
{
    fake.emulation.folder = [](const std::string&) {
        return std::string{"root:x:0:0\nsecret of line two\n"};
    };
    for (const std::string law :
         {"delay = { law = \"trace\"", "delay = { law = \"table\"", "loss = { law = \"trace\"",
          "loss = { law = \"timed-trace\"", "rate = { law = \"trace\""}) {
        const auto error = refusal_of(
            {{"command", "apply"}, {"profile", "both." + law + ", file = \"shadow\" }"}});
        EXPECT_NE(error.find("shadow"), std::string::npos) << error;
        EXPECT_EQ(error.find("root"), std::string::npos) << error;
        EXPECT_EQ(error.find("secret"), std::string::npos) << error;
    }
}

TEST_F(FilesOfRequests, AreBounded)
{
    json request = traced("delays.csv");
    request["files"] = {{"delays.csv", std::string(sent_bytes_max, '1')}, {"more", "1"}};
    EXPECT_NE(refusal_of(request).find("1048577 bytes together; 1048576 may be"),
              std::string::npos);
    request["files"] = json::object();
    for (std::size_t i = 0; i <= files_max; ++i) request["files"][std::to_string(i)] = "";
    EXPECT_EQ(refusal_of(request), "more than 64 files");
    request["files"] = {{"delays.csv", 7}};
    EXPECT_EQ(refusal_of(request), "the text of the file \"delays.csv\" must be a string");
    request["files"] = "delays.csv";
    EXPECT_NE(refusal_of(request).find("\"files\" must be an object"), std::string::npos);
}

} // namespace
} // namespace hapnet::emulator
