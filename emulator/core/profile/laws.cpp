// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/laws.hpp"

#include "proto/base/fields.hpp"
#include "proto/base/text.hpp"

#include <array>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

template <typename... Laws>
constexpr std::array<std::string_view, sizeof...(Laws)> names_of_laws(const std::variant<Laws...>*)
{
    return {base::described_name<Laws>...};
}

/// Reads the law that { law = "name", ... } names, with its parameters. They must be the last keys
/// that are read from the table.
template <typename... Laws>
std::variant<Laws...> read_law(TableReader& table, std::variant<Laws...> otherwise)
{
    constexpr auto names = names_of_laws(static_cast<std::variant<Laws...>*>(nullptr));
    Reading& reading = table.reading();
    std::string name;
    const Node* node = table.require("law", fmt::format("use one of {}", fmt::join(names, ", ")));
    if (node == nullptr) return otherwise;
    read_value(*node, name, reading);
    bool is_found = false;
    const auto read = [&]<typename Law>(std::in_place_type_t<Law>) {
        if (base::described_name<Law> != name) return;
        is_found = true;
        Law law;
        base::read_fields(table, law);
        table.finish(); // not for an unknown law: its parameters are unknown, too
        if constexpr (requires { law.load(reading); }) {
            const auto loaded = reading.is_good() ? law.load(reading) : base::Result<void>{};
            if (!loaded) reading.complain(table.place(), loaded.error().message);
        }
        otherwise = std::move(law);
    };
    (read(std::in_place_type<Laws>), ...);
    if (!is_found) {
        reading.complain(node->place, fmt::format("unknown law {}: {}", base::in_quotes(name),
                                                  suggestion(name, names)));
    }
    return otherwise;
}

template <typename Law>
void check(const Law& law, Place place, Reading& reading)
{
    if (!reading.is_good()) return;
    if (const auto valid = validate(law); !valid) reading.complain(place, valid.error().message);
}

bool is_text(const Node& node, std::string_view text)
{
    const auto* own = std::get_if<std::string>(&node.value);
    return own != nullptr && *own == text;
}

Variation read_law_table(const Node& node, const Node::Table& entries, std::optional<Order>& order,
                         Reading& reading)
{
    TableReader table{entries, node.place, reading};
    const Node* time = table.find("correlation_time");
    const Node* order_node = table.find("order");
    Variation variation;
    variation.law = read_law(table, variation.law);
    if (time != nullptr) read_value(*time, variation.correlation_time, reading);
    if (order_node != nullptr) order = read_order(*order_node, reading);
    return variation;
}

LossLaw read_loss(const Node& node, Reading& reading)
{
    LossLaw law;
    if (const auto* entries = std::get_if<Node::Table>(&node.value)) {
        TableReader table{*entries, node.place, reading};
        law = read_law(table, law);
    } else if (const auto* text = std::get_if<std::string>(&node.value);
               text != nullptr && text->find('/') != std::string::npos) {
        law = read_burst(node, reading);
    } else {
        RandomLoss random;
        read_value(node, random.share, reading);
        law = random;
    }
    check(law, node.place, reading);
    return law;
}

template <typename Law>
std::vector<std::string> law_texts(const Law& law)
{
    return std::visit(
        []<typename One>(const One& one) {
            auto texts = base::field_texts(one, base::Print::needed);
            texts.insert(texts.begin(),
                         fmt::format("law = {}", base::quoted(base::described_name<One>)));
            return texts;
        },
        law);
}

std::string loss_text(const LossLaw& law)
{
    if (const auto* random = std::get_if<RandomLoss>(&law)) return value_text(random->share);
    const auto* burst = std::get_if<Burst>(&law);
    if (burst != nullptr && !burst->phase) {
        return base::quoted(fmt::format("{}/{}", burst->lost, burst->of));
    }
    return table_text(law_texts(law));
}

} // namespace

Variation read_variation(const Node& node, Role role, std::optional<Order>& order, Reading& reading)
{
    Variation variation;
    if (is_text(node, "none")) return variation;
    if (const auto* entries = std::get_if<Node::Table>(&node.value)) {
        variation = read_law_table(node, *entries, order, reading);
    } else {
        base::Duration value{};
        read_value(node, value, reading);
        if (role == Role::jitter && value < base::Duration{0}) {
            reading.complain(node.place,
                             fmt::format("{}: a jitter cannot be negative: {} is -{} to +{}",
                                         base::what_it_is(node), base::to_text(-value),
                                         base::to_text(-value), base::to_text(-value)));
        }
        if (role == Role::delay) variation.law = ConstantLaw{value};
        if (role == Role::jitter) variation.law = UniformLaw{.half_width = value};
    }
    check(variation, node.place, reading);
    return variation;
}

std::string variation_text(const Variation& variation, Role role)
{
    const auto* constant = std::get_if<ConstantLaw>(&variation.law);
    const auto* uniform = std::get_if<UniformLaw>(&variation.law);
    if (variation.correlation_time == base::Duration{0}) {
        if (role == Role::delay && constant != nullptr) return value_text(constant->value);
        if (role == Role::jitter && variation == Variation{}) return base::quoted("none");
        if (role == Role::jitter && uniform != nullptr && uniform->mean == base::Duration{0}) {
            return value_text(uniform->half_width);
        }
    }
    auto texts = law_texts(variation.law);
    if (variation.correlation_time != base::Duration{0}) {
        texts.push_back("correlation_time = " + value_text(variation.correlation_time));
    }
    return table_text(texts);
}

std::vector<LossLaw> read_losses(const Node& node, Reading& reading)
{
    if (is_text(node, "none")) return {};
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) return {read_loss(node, reading)};
    std::vector<LossLaw> laws;
    for (const Node& element : *list) {
        if (laws.size() == loss_laws_max) {
            reading.complain(
                element.place,
                fmt::format("a direction can have at most {} laws of loss", loss_laws_max));
            break;
        }
        laws.push_back(read_loss(element, reading));
    }
    return laws;
}

std::string losses_text(const std::vector<LossLaw>& laws)
{
    if (laws.empty()) return base::quoted("none");
    if (laws.size() == 1) return loss_text(laws.front());
    std::string text;
    for (const LossLaw& law : laws) text += (text.empty() ? "" : ", ") + loss_text(law);
    return "[" + text + "]";
}

Burst read_burst(const Node& node, Reading& reading)
{
    const auto* text = std::get_if<std::string>(&node.value);
    const auto slash = text == nullptr ? std::string::npos : text->find('/');
    if (slash != std::string::npos) {
        constexpr auto most = std::numeric_limits<std::uint32_t>::max();
        const auto lost = base::parse_count(std::string_view{*text}.substr(0, slash), most);
        const auto of = base::parse_count(std::string_view{*text}.substr(slash + 1), most);
        if (lost && of) {
            return {static_cast<std::uint32_t>(*lost), static_cast<std::uint32_t>(*of), {}};
        }
    }
    reading.complain(node.place, fmt::format("{} is not a burst: write '40/100' to lose 40 in a "
                                             "row of every 100",
                                             base::what_it_is(node)));
    return {1, 1, {}};
}

Order read_order(const Node& node, Reading& reading)
{
    Order order = Order::keep;
    base::Choice{}.read(node, order, reading);
    return order;
}

} // namespace hapnet::emulator
