// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/subjects.hpp"

#include <algorithm>

namespace hapnet::lab::metrics {

void SubjectMeans::add(const std::optional<std::string>& subject, double value)
{
    const auto known = subject ? std::ranges::find(sums_, subject, &Sum::subject) : sums_.end();
    Sum& sum = known == sums_.end() ? sums_.emplace_back(Sum{subject}) : *known;
    sum.sum += value;
    ++sum.count;
}

std::vector<double> SubjectMeans::means() const
{
    std::vector<double> means;
    for (const Sum& one : sums_) means.push_back(one.sum / static_cast<double>(one.count));
    return means;
}

} // namespace hapnet::lab::metrics
