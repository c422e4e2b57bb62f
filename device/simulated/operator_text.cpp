// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/keys.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/signal_history.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

// Beyond what hands are; within them a step of 2 ms is not long against what a hand does.
constexpr Range hand_mass{base::mass_kind, 0.02, 10.0};
constexpr Range hand_damping{base::damping_kind, 0.0, 100.0};
constexpr Range hand_stiffness{base::stiffness_kind, 1.0, 5000.0};
constexpr Range unrest_amplitude{base::length_kind, 0.0, 0.1};
constexpr Range unrest_frequency{base::frequency_kind, 0.0, 100.0};
constexpr Range will_gain{base::mobility_kind, 0.0, 1.0};
constexpr Range will_cutoff{base::frequency_kind, 0.01, 100.0};
constexpr Plain reflex_gain{0.0, 10.0};

template <typename Keys, typename Person>
void list_operator_keys(Keys& keys, Person& person)
{
    keys.value("mass", person.hand.mass_kg, hand_mass);
    keys.value("damping", person.hand.damping_ns_per_m, hand_damping);
    keys.value("stiffness", person.hand.stiffness_n_per_m, hand_stiffness);
    const auto list_unrest = [](auto& unrest) {
        return [&unrest](auto& inner) {
            inner.value("amplitude", unrest.amplitude_m, unrest_amplitude);
            inner.value("from", unrest.least_hertz, unrest_frequency);
            inner.value("to", unrest.most_hertz, unrest_frequency);
        };
    };
    keys.group("wander", list_unrest(person.wander));
    keys.group("tremor", list_unrest(person.tremor));
    keys.value("force_noise", person.force_noise);
    keys.group("reflex", [&person](auto& inner) {
        inner.value("gain", person.reflex.gain, reflex_gain);
        inner.value("delay", person.reflex.delay, SignalHistory::delay_max);
    });
    keys.group("will", [&person](auto& inner) {
        inner.value("gain", person.intent.gain_m_per_ns, will_gain);
        inner.value("cutoff", person.intent.cutoff_hertz, will_cutoff);
        inner.value("delay", person.intent.delay, SignalHistory::delay_max);
    });
}

std::optional<Operator> read_preset(const base::Node& node, base::Reading& reading)
{
    std::string name;
    base::read_value(node, name, reading);
    if (!reading.is_good()) return std::nullopt;
    auto preset = operator_named(name);
    if (preset) return *std::move(preset);
    reading.complain(node.place, preset.error().message);
    return std::nullopt;
}

} // namespace

std::optional<Operator> read_operator(const base::Node& node, base::Reading& reading)
{
    const auto* entries = std::get_if<base::Node::Table>(&node.value);
    if (entries == nullptr) return read_preset(node, reading);
    base::TableReader table{*entries, node.place, reading};
    Operator person;
    if (const base::Node* preset = table.find("preset")) {
        const auto found = read_preset(*preset, reading);
        if (!found) return std::nullopt;
        person = *found;
    }
    if (const base::Node* name = table.find("name")) base::read_value(*name, person.name, reading);
    KeyReader keys{table};
    list_operator_keys(keys, person);
    table.finish();
    if (!reading.is_good()) return std::nullopt;
    return person;
}

base::Result<Operator> load_operator(const std::string& name_or_file, const base::OpenFile& open)
{
    const bool is_file =
        name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".toml");
    if (!is_file) return operator_named(name_or_file);
    const auto text = open(name_or_file);
    if (!text) return tl::unexpected{text.error()};
    base::Reading reading{name_or_file};
    const auto document = base::parse_document(*text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    auto person = read_operator(*document, reading);
    if (!person) return base::fail(*reading.complaint());
    return *std::move(person);
}

std::string print_operator(const Operator& person)
{
    KeyPrinter keys;
    list_operator_keys(keys, person);
    return fmt::format("name = {}\n{}", base::quoted(person.name), keys.text());
}

} // namespace hapnet::device
