// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/request.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hapnet::ctl {
namespace {

using namespace std::chrono_literals;

TEST(Request, HoldsWhatWasAskedFor)
{
    Options options;
    options.command = "set";
    options.settings = {{"both.delay", "10ms"}, {"up.loss", "1%"}};
    options.lasting = 30s;
    EXPECT_EQ(make_request(options)->dump(),
              R"({"command":"set","settings":{"both.delay":"10ms","up.loss":"1%"},"for":"30s"})");
}

TEST(Request, HoldsAProfileAndItsAbsolutePath)
{
    const std::string file = testing::TempDir() + "hapnet-ctl-request.toml";
    std::ofstream{file} << "[both]\ndelay = \"1ms\"\n";
    Options options;
    options.command = "apply";
    options.file = file;
    const auto request = make_request(options);
    EXPECT_EQ(request->at("profile"), "[both]\ndelay = \"1ms\"\n");
    EXPECT_EQ(request->at("file"), std::filesystem::absolute(file).string());
    std::filesystem::remove(file);
}

TEST(Request, SaysHowAPresetIsApplied)
{
    Options options;
    options.socket = "e.sock";
    options.command = "apply";
    options.file = "no-such-preset";
    const std::string said = make_request(options).error().message;
    EXPECT_NE(said.find("hapnet-emulator check no-such-preset | hapnet-ctl e.sock apply -"),
              std::string::npos)
        << said;
    options.file = "no/such.toml";
    EXPECT_EQ(make_request(options).error().message.find("hapnet-emulator check"),
              std::string::npos);
}

} // namespace
} // namespace hapnet::ctl
