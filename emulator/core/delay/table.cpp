// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/table.hpp"

#include "emulator/core/trace/rows.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

QuantileTable::QuantileTable(std::vector<double> values, Unit unit)
    : values_{std::move(values)}, unit_{unit}
{
    base::ensure(!values_.empty() && values_.size() <= values_max);
    std::sort(values_.begin(), values_.end());
    base::ensure(std::isfinite(values_.front()) && std::isfinite(values_.back()));
    if (values_.front() == values_.back()) {
        mean_ = values_.front();
        return;
    }
    // Each piece [a, b] is uniform: its mean is (a + b) / 2, its mean square (a^2 + ab + b^2) / 3.
    const auto pieces = static_cast<double>(values_.size() - 1);
    double sum = 0.0;
    for (std::size_t i = 1; i < values_.size(); ++i) sum += 0.5 * (values_[i - 1] + values_[i]);
    mean_ = sum / pieces;
    double squares = 0.0;
    for (std::size_t i = 1; i < values_.size(); ++i) {
        const double a = values_[i - 1] - mean_;
        const double b = values_[i] - mean_;
        squares += (a * a + a * b + b * b) / 3.0;
    }
    sd_ = std::sqrt(squares / pieces);
}

double QuantileTable::quantile(double u) const
{
    if (values_.size() == 1) return values_.front();
    const double place = u * static_cast<double>(values_.size() - 1);
    const auto piece = std::min(static_cast<std::size_t>(place), values_.size() - 2);
    const double low = values_[piece];
    const double high = values_[piece + 1];
    // Rounding must not make the result greater than the next value: the function ascends.
    return std::min(low + (place - static_cast<double>(piece)) * (high - low), high);
}

bool TableLaw::is_as_measured() const
{
    constexpr base::Duration zero{0};
    return table->holds_delays() && mean == zero && sd == zero;
}

base::Result<void> TableLaw::load(const base::Reading& reading)
{
    const auto format = parse_format(columns);
    if (!format) return tl::unexpected{format.error()};
    const auto text = base::open_measured(reading, file);
    if (!text) return tl::unexpected{text.error()};
    const bool is_dist = file.ends_with(".dist");
    auto read = is_dist ? parse_dist(*text) : parse_samples(*text, *format);
    if (!read) return tl::unexpected{reading.trouble_in(file, read.error().message)};
    table = *std::move(read);
    return {};
}

base::Result<void> TableLaw::validate() const
{
    base::ensure(table != nullptr);
    constexpr base::Duration zero{0};
    return all({require_ranges(*this),
                require(sd > zero || is_as_measured(), "sd must be more than 0"),
                require(sd == zero || table->sd() > 0.0,
                        "all values of the table are equal: leave out sd")});
}

LawMoments TableLaw::moments() const
{
    if (!is_as_measured()) return {mean, sd};
    return {rounded(table->mean()), rounded(table->sd())};
}

bool operator==(const TableLaw& a, const TableLaw& b)
{
    const bool is_same =
        a.file == b.file && a.mean == b.mean && a.sd == b.sd && a.columns == b.columns;
    if (!is_same) return false;
    return a.table == b.table || (a.table && b.table && *a.table == *b.table);
}

TableLaw::Sampler::Sampler(const TableLaw& law) : table_{law.table}
{
    base::ensure(table_ != nullptr);
    if (law.is_as_measured()) return;
    scale_ = table_->sd() > 0.0 ? base::to_nanoseconds(law.sd) / table_->sd() : 0.0;
    offset_ = base::to_nanoseconds(law.mean) - scale_ * table_->mean();
}

base::Duration TableLaw::Sampler::quantile(double u) const
{
    return bounded(offset_ + scale_ * table_->quantile(u));
}

base::Result<std::shared_ptr<const QuantileTable>> parse_dist(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\f\v";
    std::vector<double> values;
    base::LineReader lines{text};
    while (const auto line = lines.next()) {
        auto rest = *line;
        while (!rest.empty()) {
            const auto word = rest.substr(0, rest.find_first_of(blanks));
            std::int32_t value = 0;
            const auto [end, error] = std::from_chars(word.begin(), word.end(), value);
            if (error != std::errc{} || end != word.end()) {
                return lines.fail(fmt::format("'{}' is not a whole number", base::shortened(word)));
            }
            if (values.size() == QuantileTable::values_max) return lines.fail(too_many_values);
            values.push_back(value);
            rest.remove_prefix(word.size());
            rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
        }
    }
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    if (values.empty() || *least == *greatest) {
        return lines.fail("the file ends without two numbers that differ");
    }
    return std::make_shared<const QuantileTable>(std::move(values), QuantileTable::Unit::own);
}

base::Result<std::shared_ptr<const QuantileTable>> parse_samples(std::string_view text,
                                                                 const TableFormat& format)
{
    const auto rows = read_trace_rows(text, Measure::delay, format);
    if (!rows) return base::fail(rows.error().message);
    const auto delays = rows->delays();
    std::vector<double> values;
    values.reserve(delays.size());
    for (std::size_t i = 0; i < delays.size(); ++i) {
        if (!rows->lost[i]) values.push_back(static_cast<double>(delays[i].count()));
    }
    return std::make_shared<const QuantileTable>(std::move(values),
                                                 QuantileTable::Unit::nanoseconds);
}

} // namespace hapnet::emulator
