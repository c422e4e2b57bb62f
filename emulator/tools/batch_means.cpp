// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/batch_means.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace hapnet::emulator::tools {

namespace {

constexpr double widths_of_95_percent = 1.96;

double mean_of(std::span<const double> values)
{
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Returns the standard error of the mean of consecutive values.
double error_of_mean(std::span<const double> values)
{
    const double mean = mean_of(values);
    double squares = 0.0;
    double products = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        squares += (values[i] - mean) * (values[i] - mean);
        if (i > 0) products += (values[i] - mean) * (values[i - 1] - mean);
    }
    if (squares <= 0.0) return 0.0;
    constexpr double most = 0.99; // reached by a series that only rises
    const double correlation = std::clamp(products / squares, 0.0, most);
    const auto n = static_cast<double>(values.size());
    const double independent = std::sqrt(squares / (n - 1.0) / n);
    return independent * std::sqrt((1.0 + correlation) / (1.0 - correlation));
}

} // namespace

void BatchMeans::Sums::add(const Sums& other)
{
    count += other.count;
    first += other.first;
    second += other.second;
}

void BatchMeans::add(double value)
{
    if (count_++ == 0) origin_ = value;
    const double deviation = value - origin_;
    open_.add({1.0, deviation, deviation * deviation});
    if (open_.count < batch_size_) return;
    batches_.push_back(open_);
    open_ = {};
    if (batches_.size() < 2 * batches_min) return;
    for (std::size_t i = 0; i < batches_min; ++i) {
        batches_[i] = batches_[2 * i];
        batches_[i].add(batches_[2 * i + 1]);
    }
    batches_.resize(batches_min);
    batch_size_ *= 2.0;
}

/// The error of the deviation follows from that of the mean squared deviation from the overall
/// mean, by d(sd) = d(variance) / (2 sd).
std::optional<Precision> BatchMeans::precision() const
{
    if (batches_.size() < batches_min) return std::nullopt;
    Sums all;
    for (const Sums& batch : batches_) all.add(batch);
    const double shift = all.first / all.count;
    const double variance = all.second / all.count - shift * shift;
    std::vector<double> means;
    std::vector<double> variances; // of batches, about the mean of all values
    for (const Sums& batch : batches_) {
        const double mean = batch.first / batch.count;
        means.push_back(mean);
        variances.push_back(batch.second / batch.count - 2.0 * shift * mean + shift * shift);
    }
    const auto share = [](double error, double of) {
        return error <= 0.0 ? 0.0 : widths_of_95_percent * error / std::abs(of);
    };
    // A variance below a millionth of the values is due to rounding.
    const double scale = std::abs(origin_ + shift);
    const bool is_constant = variance <= 1e-12 * scale * scale;
    if (is_constant) return Precision{};
    return Precision{share(error_of_mean(means), origin_ + shift),
                     share(error_of_mean(variances), 2.0 * variance)};
}

} // namespace hapnet::emulator::tools
