// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/fields.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/fields.hpp"

#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::lab::experiment {

namespace {

/// The fields of a struct. In TOML all bare keys come before the first table.
struct Written {
    std::string lines;
    std::string tables;
};

std::string below_head(const std::string& name, const std::string& lines)
{
    return lines.empty() ? "" : fmt::format("\n[{}]\n{}", name, lines);
}

Written written(const base::FieldTable& fields, const void* value, const std::string& prefix = {})
{
    Written text;
    for (const base::FieldRow& row : fields.rows) {
        const base::ValueKind& plain = row.kind->plain();
        const void* member = row.in(value);
        const bool is_maybe = row.kind != &plain;
        if (plain.shape != base::ValueKind::Shape::record) {
            const auto line = base::field_text(row, value);
            if (line) text.lines += fmt::format("{} = {}\n", row.key, *line);
        } else if (!is_maybe || row.kind->size(member) > 0) {
            const std::string name = prefix + std::string{row.key};
            const Written own = written(
                plain.table(), is_maybe ? row.kind->element_at(member, 0) : member, name + '.');
            text.tables += below_head(name, own.lines) + own.tables;
        }
    }
    return text;
}

template <base::Described T>
Written written(const T& value)
{
    return written(base::field_table<T>(), &value);
}

Written written_kind(const Kind& kind)
{
    return std::visit(
        []<typename One>(const One& one) {
            Written text = written(one);
            if (!has_own_table<One>) return text;
            return Written{"", below_head(std::string{base::described_name<One>}, text.lines)};
        },
        kind);
}

} // namespace

std::string to_text(const Experiment& experiment)
{
    std::string out;
    for (const std::string& line : base::field_texts(experiment, base::Print::needed)) {
        const bool is_of_scripts =
            experiment.is_as_long_as_scripts && line.starts_with("duration = ");
        out += (is_of_scripts ? "duration = \"script\"" : line) + '\n';
    }
    const Written kind = written_kind(experiment.kind);
    out += kind.lines + emulator::to_text(emulator::Profile{
                            {}, {}, experiment.path, experiment.timeline, experiment.links});
    out += kind.tables;
    for (const NamedAlgorithm& named : experiment.algorithms) {
        out += fmt::format("\n[algorithm.{}]\n{}", base::quoted(named.name),
                           peer::print_algorithm(named.algorithm));
    }
    return out;
}

} // namespace hapnet::lab::experiment
