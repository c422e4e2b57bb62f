// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::metrics {

/// One value for each subject: the mean of all that belong to it, so that a subject counts once,
/// however many trials and seeds it has. Statistics over seeds, taken of these values, are between
/// subjects. A value without a subject stands for itself.
class SubjectMeans {
public:
    void add(const std::optional<std::string>& subject, double value);

    /// The means in the order in which the subjects first came.
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
