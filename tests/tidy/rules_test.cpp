// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/arrows.hpp"
#include "tests/tidy/rules.hpp"

#include <gtest/gtest.h>

namespace hapnet::tidy {
namespace {

// Every rule meets a sample that breaks it: a rule that cannot complain proves nothing.

const std::string licence = "// SPDX-FileCopyrightText: 2026 The Hapnet authors\n"
                            "// SPDX-License-Identifier: MIT\n";

std::string repeated(int times, const std::string& text)
{
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

TEST(Arrows, AFolderOfTheMapIsTheDeepestThatHoldsThePath)
{
    EXPECT_EQ(folder_of("emulator/core/link.hpp"), "emulator/core");
    EXPECT_EQ(folder_of("emulator/ports/relay.hpp"), "emulator");
    EXPECT_EQ(folder_of("device/simulated/omni.hpp"), "device");
    EXPECT_EQ(folder_of("tests/unit/proto/base/time_test.cpp"), "");
    EXPECT_EQ(folder_of("emulatorx/core/link.hpp"), "");
}

TEST(Arrows, ComposeAndLeadOneWay)
{
    EXPECT_TRUE(may_include("peer/core", "proto/wire"));
    EXPECT_TRUE(may_include("peer/core", "proto/base")); // by way of wire
    EXPECT_TRUE(may_include("lab/cli", "device"));       // by way of lab
    EXPECT_FALSE(may_include("proto/base", "proto/wire"));
    EXPECT_FALSE(may_include("emulator", "proto/wire")); // it relays opaque datagrams
    EXPECT_FALSE(may_include("emulator", "peer/core"));
    EXPECT_FALSE(may_include("peer", "emulator/core"));
    EXPECT_FALSE(may_include("peer/core", "proto/net"));
    EXPECT_FALSE(may_include("lab", "proto/net"));
}

TEST(Arrows, AnIncludeAgainstThemIsFound)
{
    const auto wrong = source_file("emulator/core/x.cpp", "#include \"proto/wire/message.hpp\"\n");
    const auto right = source_file("peer/core/x.cpp", "#include \"proto/wire/message.hpp\"\n");
    EXPECT_EQ(wrong_arrows(wrong).size(), 1U);
    EXPECT_EQ(wrong_arrows(right).size(), 0U);
}

TEST(Arrows, AnIncludeThatIsNoPathFromTheRootIsFound)
{
    const std::string text = "#include \"message.hpp\"\n#include \"../wire/message.hpp\"\n";
    EXPECT_EQ(wrong_arrows(source_file("proto/wire/x.cpp", text)).size(), 2U);
    EXPECT_EQ(wrong_arrows(source_file("tests/unit/wire/x.cpp", text)).size(), 2U);
}

TEST(Arrows, TestsMayIncludeEverythingAndProgramsNoTests)
{
    const std::string text = "#include \"peer/loop.hpp\"\n#include \"tests/e2e/process.hpp\"\n";
    EXPECT_EQ(wrong_arrows(source_file("tests/e2e/x.cpp", text)).size(), 0U);
    EXPECT_EQ(wrong_arrows(source_file("peer/x.cpp", text)).size(), 1U);
}

TEST(Purity, ACoreMayNotIncludeWhatDoesInputOrOutput)
{
    for (const std::string_view header : {"thread", "mutex", "iostream", "fstream", "filesystem",
                                          "ctime", "sys/socket.h", "unistd.h", "spdlog/spdlog.h"}) {
        const auto text = "#include <" + std::string{header} + ">\n";
        EXPECT_EQ(impure_includes(source_file("peer/core/x.cpp", text)).size(), 1U) << header;
        EXPECT_EQ(impure_includes(source_file("device/x.cpp", text)).size(), 1U) << header;
        EXPECT_EQ(impure_includes(source_file("peer/x.cpp", text)).size(), 0U) << header;
    }
}

TEST(Purity, ACoreMayFormatTextAndSpeakOfDurations)
{
    const std::string text = "#include <chrono>\n#include <spdlog/fmt/fmt.h>\n#include <vector>\n";
    EXPECT_EQ(impure_includes(source_file("peer/core/x.cpp", text)).size(), 0U);
}

TEST(Lengths, AFileOf601LinesIsTooLong)
{
    EXPECT_EQ(lengths(source_file("peer/x.cpp", repeated(600, "\n"))).size(), 0U);
    EXPECT_EQ(lengths(source_file("peer/x.cpp", repeated(601, "\n"))).size(), 1U);
    EXPECT_EQ(lengths(source_file("README.md", repeated(601, "\n"))).size(), 0U);
}

TEST(Lengths, ALineOf101CharactersIsTooLongAndNotOneOf101Bytes)
{
    EXPECT_EQ(lengths(source_file("peer/x.cpp", repeated(100, "x"))).size(), 0U);
    EXPECT_EQ(lengths(source_file("peer/x.cpp", repeated(101, "x"))).size(), 1U);
    EXPECT_EQ(lengths(source_file("peer/x.cpp", repeated(100, "\u00e9"))).size(), 0U);
}

TEST(Lengths, AFunctionOf61LinesIsTooLong)
{
    const auto function = [](int statements) {
        return "    void f()\n    {\n" + repeated(statements, "        g();\n") + "    }\n";
    };
    EXPECT_EQ(long_functions(source_file("peer/x.cpp", function(58))).size(), 0U);
    EXPECT_EQ(long_functions(source_file("peer/x.cpp", function(59))).size(), 1U);
    EXPECT_EQ(long_functions(source_file("peer/x.cpp", function(58) + function(58))).size(), 0U);
    const std::string spaced =
        "    {\n" + repeated(10, "        g();\n\n        g();\n\n\n\n") + "    }\n";
    EXPECT_EQ(long_functions(source_file("peer/x.cpp", spaced)).size(), 1U);
    const std::string requirement = "    {\n        f()\n        } -> std::same_as<int>;\n";
    EXPECT_EQ(long_functions(source_file("peer/x.hpp", requirement + function(58))).size(), 0U);
    EXPECT_EQ(long_functions(source_file("peer/x.hpp",
                                         "    {\n        f()\n    } -> g;\n" + repeated(80, "\n")))
                  .size(),
              0U);
}

TEST(Words, AreBannedWhereTheyDoNotBelong)
{
    const auto complaints = [](const std::string& path, const std::string& line) {
        return banned_words(source_file(path, line)).size();
    };
    EXPECT_EQ(complaints("peer/x.cpp", "ra"
                                       "nd() % 6"),
              1U);
    EXPECT_EQ(complaints("peer/x.cpp", "std::ra"
                                       "nd()"),
              1U);
    EXPECT_EQ(complaints("peer/x.cpp", "opera"
                                       "nd(x)"),
              0U);
    EXPECT_EQ(complaints("peer/x.cpp", "steady_clock::no"
                                       "w()"),
              1U);
    EXPECT_EQ(complaints("proto/net/clock.cpp", "steady_clock::no"
                                                "w()"),
              0U);
    EXPECT_EQ(complaints("tests/unit/x.cpp", "sleep_"
                                             "for(1s)"),
              1U);
    EXPECT_EQ(complaints("tests/e2e/x.cpp", "sleep_"
                                            "for(1s)"),
              0U);
    EXPECT_EQ(complaints("README.md", "TO"
                                      "DO"),
              1U);
    EXPECT_EQ(complaints("scripts/x.sh", "# FIX"
                                         "ME"),
              1U);
    EXPECT_EQ(complaints("docs/x.md", "see ../sha"
                                      "red"),
              1U);
}

TEST(Licence, HasItsTwoLinesOnTopOrBelowTheInterpreter)
{
    EXPECT_EQ(missing_licence(source_file("peer/x.cpp", licence)).size(), 0U);
    EXPECT_EQ(missing_licence(source_file("peer/x.cpp", "\n" + licence)).size(), 1U);
    EXPECT_EQ(missing_licence(source_file("peer/x.cpp", "")).size(), 1U);
    EXPECT_EQ(missing_licence(source_file("x.sh", "#!/bin/sh\n" + licence)).size(), 0U);
    EXPECT_EQ(missing_licence(source_file("x.sh", "#!/bin/sh\n")).size(), 1U);
    EXPECT_EQ(missing_licence(source_file("page/x.js", "let x;\n")).size(), 1U);
}

TEST(DeadFiles, AreSourcesThatNothingBuildsAndHeadersThatNothingIncludes)
{
    const auto complaints = dead_files({
        source_file("peer/CMakeLists.txt", "hapnet_program(p\n    SOURCES loop.cpp main.cpp)\n"),
        source_file("peer/loop.cpp", "#include \"peer/loop.hpp\"\n"),
        source_file("peer/loop.hpp", ""),
        source_file("peer/main.cpp", ""),
        source_file("peer/old.cpp", "// peer/old.hpp\n"),
        source_file("peer/old.hpp", ""),
        source_file("lab/main.cpp", ""), // another folder's main.cpp is built
        source_file("tests/unit/peer/loop_test.cpp", ""),
    });
    ASSERT_EQ(complaints.size(), 3U);
    EXPECT_EQ(dead_files({source_file("tests/CMakeLists.txt", "bench/${subject}/x.cpp)\n"),
                          source_file("tests/bench/lab/x.cpp", ""),
                          source_file("tests/bench/lab/more/x.cpp", "")})
                  .size(),
              1U);
    EXPECT_EQ(complaints[0].find("peer/old.cpp"), 0U);
    EXPECT_EQ(complaints[1].find("peer/old.hpp"), 0U);
    EXPECT_EQ(complaints[2].find("lab/main.cpp"), 0U);
}

TEST(Namespaces, AreThoseOfTheFolderOrOfOneAbove)
{
    const auto complaints = [](const char* path, const std::string& name) {
        return wrong_namespaces(source_file(path, "namespace " + name + " {\n")).size();
    };
    EXPECT_EQ(complaints("lab/metrics/json.hpp", "hapnet::lab::metrics"), 0U);
    EXPECT_EQ(complaints("scene/rigid/step.hpp", "hapnet::scene"), 0U);
    EXPECT_EQ(complaints("emulator/core/link.hpp", "hapnet::emulator"), 0U);
    EXPECT_EQ(complaints("proto/base/time.hpp", "hapnet::base::literals"), 0U);
    EXPECT_EQ(complaints("lab/metrics/json.hpp", "hapnet::lab::results"), 1U);
    EXPECT_EQ(complaints("lab/metrics/json.hpp", "hapnet::lab_tools"), 1U);
    EXPECT_EQ(complaints("peer/core/side.hpp", "hapnet::device"), 1U);
}

TEST(UnitTests, AreCalledAsAFileOrAsOneOfItsAspects)
{
    const auto complaints = [](const char* test) {
        return unmirrored_tests({source_file("scene/rigid/free_flight.cpp", ""),
                                 source_file("scene/rigid/step.hpp", ""), source_file(test, "")})
            .size();
    };
    EXPECT_EQ(complaints("tests/unit/scene/rigid/free_flight_test.cpp"), 0U);
    EXPECT_EQ(complaints("tests/unit/scene/rigid/step_at_rest_test.cpp"), 0U);
    EXPECT_EQ(complaints("tests/unit/scene/rigid/flight_test.cpp"), 1U);
    EXPECT_EQ(complaints("tests/unit/scene/step_test.cpp"), 1U);
}

} // namespace
} // namespace hapnet::tidy
