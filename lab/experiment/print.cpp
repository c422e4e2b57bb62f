// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/fields.hpp"
#include "lab/experiment/text.hpp"
#include "peer/core/sync/text.hpp"

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

template <base::Described T>
Written written(const T& value, const std::string& prefix = {})
{
    Written text;
    const auto add_table = [&](const std::string& name, const auto& part) {
        const Written own = written(part, name + '.');
        text.tables += below_head(name, own.lines) + own.tables;
    };
    base::for_each_field(
        [&]<typename Member>(const auto& field, const Member& member) {
            const std::string name = prefix + std::string{field.key};
            if constexpr (base::Described<Member>) {
                add_table(name, member);
            } else if constexpr (requires {
                                     requires base::Described<typename Member::value_type>;
                                 }) {
                if (member) add_table(name, *member);
            } else if (const auto line = base::field_text(field, member)) {
                text.lines += fmt::format("{} = {}\n", field.key, *line);
            }
        },
        value);
    return text;
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
        out += line + '\n';
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
