// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::metrics {

/// One value for each subject: the mean of all values of the subject. So a subject counts once,
/// however many trials and seeds it has, and statistics of these values are between subjects. A
/// value without a subject counts by itself.
class SubjectMeans {
public:
    void add(const std::optional<std::string>& subject, double value);

    /// Returns the means in the order in which the subjects first occurred.
    [[nodiscard]] std::vector<double> means() const;
    [[nodiscard]] std::size_t count() const { return sums_.size(); }

private:
    struct Sum {
        std::optional<std::string> subject;
        double sum = 0.0;
        std::size_t count = 0;
    };

    std::vector<Sum> sums_;
};

} // namespace hapnet::lab::metrics
