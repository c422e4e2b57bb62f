// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "emulator/core/trace/rows.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// A distribution given by values of equal weight. Its quantile function interpolates linearly
/// between the sorted values, from the least at 0 to the greatest at 1.
class QuantileTable {
public:
    static constexpr std::size_t values_max = trace_rows_max;

    /// The unit of the values: the file's own, or nanoseconds of delay.
    enum class Unit { own, nanoseconds };

    /// Takes 1 to values_max finite values in any order.
    QuantileTable(std::vector<double> values, Unit unit);

    /// Returns the quantile at u, 0 <= u <= 1.
    [[nodiscard]] double quantile(double u) const;

    /// Mean and standard deviation of the drawn distribution, which includes the values between the
    /// given ones by interpolation.
    [[nodiscard]] double mean() const { return mean_; }
    [[nodiscard]] double sd() const { return sd_; }

    [[nodiscard]] bool holds_delays() const { return unit_ == Unit::nanoseconds; }

    friend bool operator==(const QuantileTable&, const QuantileTable&) = default;

private:
    std::vector<double> values_; // ascending
    Unit unit_;
    double mean_ = 0.0;
    double sd_ = 0.0;
};

/// Drawn from a table: a netem .dist file, which is in units of its own, or a file of measured
/// delays. The values are scaled and shifted until their mean and sd are exactly those of the law.
/// Measured delays are used unchanged when both are zero.
struct TableLaw {
    std::string file;
    base::Duration mean{};
    base::Duration sd{};
    std::shared_ptr<const QuantileTable> table; // never null
    std::string columns{};

    class Sampler;

    [[nodiscard]] bool is_as_measured() const;
    /// Reads the file.
    [[nodiscard]] base::Result<void> load(const base::Reading& reading);
    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    /// Compares the contents: a file that was read twice gives equal laws.
    friend bool operator==(const TableLaw&, const TableLaw&);
};

constexpr auto fields_of(base::Tag<TableLaw>)
{
    return base::fields(
        "table",
        base::field("file", &TableLaw::file,
                    "a .dist file of netem, which needs `sd`, or measured delays")
            .required(),
        base::field("mean", &TableLaw::mean, any_delay, "mean; as measured if neither is given"),
        base::field("sd", &TableLaw::sd, delay_width,
                    "standard deviation; as measured if neither is given"),
        base::field("columns", &TableLaw::columns,
                    "columns of measured delays with other names: \"delay=rtt:ms\""));
}

class TableLaw::Sampler {
public:
    explicit Sampler(const TableLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    double offset_ = 0.0;
    double scale_ = 1.0;
    std::shared_ptr<const QuantileTable> table_;
};

/// Reads a table in the format of tc-netem: whole numbers between blanks, 8192 of them to one
/// standard deviation. Lines that begin with '#' are comments. At least two numbers must differ.
/// netem uses such a table unscaled, although its own tables do not have the standard deviation 1
/// (pareto: 0.82). Here the table is rescaled until mean and sd are those of the law.
[[nodiscard]] base::Result<std::shared_ptr<const QuantileTable>> parse_dist(std::string_view text);

/// Reads measured delays (see read_trace_rows). Their order does not matter.
[[nodiscard]] base::Result<std::shared_ptr<const QuantileTable>>
parse_samples(std::string_view text, const TableFormat& format = {});

} // namespace hapnet::emulator
