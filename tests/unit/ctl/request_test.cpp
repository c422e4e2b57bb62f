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

TEST(Request, NamesAPresetWhereThereIsNoSuchFile)
{
    Options options;
    options.command = "apply";
    options.file = "no-such-file";
    EXPECT_EQ(make_request(options)->dump(), R"({"command":"apply","preset":"no-such-file"})");
    options.file = "no/such.toml";
    EXPECT_NE(make_request(options).error().message.find("no/such.toml"), std::string::npos);
}

} // namespace
} // namespace hapnet::ctl
