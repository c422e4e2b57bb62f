// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/shared_object/load.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer::shared_object {
namespace {

std::string refusal_of(const std::string& file)
{
    const auto loaded = load_from_disk(file);
    return loaded ? "" : loaded.error().message;
}

TEST(Loading, GivesTheAlgorithmOfASharedObject)
{
    const auto algorithm = load_from_disk(HAPNET_EXAMPLE_BASE);
    ASSERT_TRUE(algorithm) << algorithm.error().message;
    EXPECT_TRUE(is_loaded(*algorithm));
    EXPECT_TRUE(plays_with_many(*algorithm));
    EXPECT_EQ(name_of(*algorithm), "shared-object");
}

TEST(Loading, LeavesTheAlgorithmsOfTheProgramAlone)
{
    EXPECT_EQ(name_of(load_from_disk("sep").value()), "sep");
    EXPECT_NE(refusal_of("spe"), "");
}

TEST(Loading, SaysWhatIsWrongWithAFile)
{
    EXPECT_NE(refusal_of("./no-such-file.so").find("no-such-file.so: cannot open"),
              std::string::npos)
        << refusal_of("./no-such-file.so");
    const std::string nothing = HAPNET_EXAMPLE_NOTHING; // a shared object without any function
    EXPECT_EQ(refusal_of(nothing), nothing + ": exports no hapnet_describe(), so it is no "
                                             "algorithm of hapnet/algorithm.h");
    Algorithm unnamed = algorithm_named("shared-object").value();
    EXPECT_EQ(load(unnamed).error().message,
              "shared-object: says no file; write file = \"./FILE.so\"");
}

} // namespace
} // namespace hapnet::peer::shared_object
