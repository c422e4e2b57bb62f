// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/criteria.hpp"

#include "proto/base/fields.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::metrics {

namespace {

/// Returns a description as a comment of TOML; empty when there is none.
std::string comment(std::string_view about)
{
    std::string text;
    while (!about.empty()) {
        const auto line = about.substr(0, about.find('\n'));
        about.remove_prefix(std::min(line.size() + 1, about.size()));
        text += fmt::format("# {}\n", line);
    }
    return text;
}

/// Prints each field on a line below a comment that describes it, and each table below its head.
std::string commented_lines(const base::FieldTable& fields, const void* value)
{
    std::string text;
    for (const base::FieldRow& row : fields.rows) {
        const bool is_table = row.kind->shape == base::ValueKind::Shape::record;
        if (is_table && row.kind != &base::kind_of<ByOrder>()) {
            text += fmt::format("\n[{}]\n{}", row.key,
                                commented_lines(row.kind->table(), row.in(value)));
        } else if (const auto printed = base::field_text(row, value)) {
            text += fmt::format("{}{} = {}\n", comment(row.about), row.key, *printed);
        }
    }
    return text;
}

/// Returns advice on the keys that replace a key which no longer exists; empty for all other keys.
std::string advice_on_key(std::string_view key)
{
    if (key != "stiffness_ratio_min") return {};
    return "write slow_stiffness_error_max below [usable] and stiffness_error_max below [good]; "
           "|B - B0| / |B0| judges, and not |B| / |B0|";
}

} // namespace

void FilterOrderFormat::read(const base::Node& node, FilterOrder& target,
                             base::Reading& reading) const
{
    const auto count = base::count_of(node, filter_order_counts.back()).value_or(0);
    const auto known = std::ranges::find(filter_order_counts, count);
    if (known == filter_order_counts.end()) return base::complain_of(node, describe(), reading);
    target = static_cast<FilterOrder>(known - filter_order_counts.begin());
}

std::string FilterOrderFormat::print(FilterOrder order) const
{
    return fmt::format("{}", count_of(order));
}

double at_order(const ByOrder& values, FilterOrder order)
{
    switch (order) {
    case FilterOrder::first: return values.first;
    case FilterOrder::second: return values.second;
    case FilterOrder::fourth: return values.fourth;
    }
    return values.first;
}

base::Result<Criteria> parse_criteria(std::string_view text, const std::string& source)
{
    return base::parse_text(text, source, [](const base::Node& node, base::Reading& reading) {
        reading.advise_on_keys(advice_on_key);
        Criteria criteria;
        base::read_table(node, criteria, reading);
        return criteria;
    });
}

std::string print_criteria(const Criteria& criteria)
{
    return "# When a session is usable, and when it is good. A convention that makes sessions\n"
           "# comparable, not a finding about people. docs/design/metrics.md defines each "
           "metric.\n\n" +
           commented_lines(base::field_table<Criteria>(), &criteria);
}

} // namespace hapnet::lab::metrics
