// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/subjects.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::metrics {
namespace {

TEST(SubjectMeans, CountASubjectOnceAndWhatHasNoneEachTime)
{
    SubjectMeans people;
    people.add("b", 1.0);
    people.add("a", 5.0);
    people.add("b", 2.0);
    people.add("b", 3.0);
    EXPECT_EQ(people.means(), (std::vector<double>{2.0, 5.0}));
    SubjectMeans seeds;
    seeds.add(std::nullopt, 1.0);
    seeds.add(std::nullopt, 2.0);
    EXPECT_EQ(seeds.means(), (std::vector<double>{1.0, 2.0}));
}

} // namespace
} // namespace hapnet::lab::metrics
