// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/upstream.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::emulator::ports {

namespace {

/// Returns the address to which a client's socket to the server is bound: on loopback if the server
/// is there.
net::Endpoint place_towards(const net::Endpoint& server)
{
    const bool is_v6 = server.family() == AF_INET6;
    const char* host =
        server.is_loopback() ? (is_v6 ? "::1" : "127.0.0.1") : (is_v6 ? "::" : "0.0.0.0");
    return net::resolve({host, 0}, server.family());
}

} // namespace

Upstream::Client::Client(std::uint64_t its_number, const net::Endpoint& its_address,
                         const ServerAndClients& places)
    : number{its_number},
      address{its_address},
      server{places.server},
      socket{place_towards(places.server), net::Load::bulk},
      local{socket.local()}
{}

namespace {

/// Returns sockets at one address, one for each part. Datagrams that arrived before all of them
/// existed may be in the wrong one, so they are discarded.
std::vector<net::UdpSocket> sockets_at(const net::Endpoint& place, std::size_t count)
{
    std::vector<net::UdpSocket> sockets;
    sockets.emplace_back(place, net::Load::bulk);
    while (sockets.size() < count) {
        sockets.push_back(net::UdpSocket::beside(sockets.front(), net::Load::bulk));
    }
    if (count == 1) return sockets;
    constexpr int batches_max = 1000;
    for (net::UdpSocket& socket : sockets) {
        for (int i = 0; i < batches_max && !socket.receive().empty(); ++i) continue;
    }
    return sockets;
}

} // namespace

Upstream::Upstream(ServerAndClients places, Setup setup,
                   const std::vector<std::unique_ptr<Paths>>& paths, Recorder& recorder)
    : common_{.places = std::move(places), .setup = setup, .recorder = recorder}
{
    auto sockets = sockets_at(common_.places.listen, paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        parts_.push_back(
            std::make_unique<Part>(common_, std::move(sockets[i]), *paths[i], recorder.lane(i)));
    }
    common_.own.add(local());
}

const net::Endpoint& Upstream::local() const { return parts_.front()->local_; }

std::vector<const Upstream::Client*> Upstream::clients() const
{
    std::vector<const Client*> all;
    for (const auto& part : parts_) {
        for (const auto& client : part->clients_) {
            if (client) all.push_back(client.get());
        }
    }
    std::ranges::sort(all, {}, &Client::number);
    return all;
}

Upstream::Departed Upstream::departed() const
{
    Departed sum;
    for (const auto& part : parts_) {
        const Departed& own = part->departed_;
        sum.up.add(own.up);
        sum.down.add(own.down);
        sum.flows.resize(std::max(sum.flows.size(), own.flows.size()));
        for (std::size_t i = 0; i < own.flows.size(); ++i) {
            sum.flows[i].up.add(own.flows[i].up);
            sum.flows[i].down.add(own.flows[i].down);
        }
        sum.strangers_down += own.strangers_down;
        sum.overflowed_down += own.overflowed_down;
        sum.unreachable_up += own.unreachable_up;
        sum.count += own.count;
    }
    return sum;
}

std::uint64_t Upstream::strangers() const
{
    std::uint64_t sum = 0;
    for (const auto& part : parts_) sum += part->strangers_;
    return sum;
}

std::uint64_t Upstream::refused() const
{
    std::uint64_t sum = 0;
    for (const auto& part : parts_) sum += part->refused_;
    return sum;
}

std::uint64_t Upstream::overflowed() const
{
    std::uint64_t sum = 0;
    for (const auto& part : parts_) sum += part->listening_.overflowed();
    return sum;
}

std::uint64_t Upstream::unreachable() const
{
    std::uint64_t sum = 0;
    for (const auto& part : parts_) sum += part->listening_.unreachable();
    return sum;
}

Upstream::Part::Part(Common& common, net::UdpSocket listening, Paths& paths,
                     Recorder::Lane& recorder)
    : common_{common},
      paths_{paths},
      recorder_{recorder},
      listening_{std::move(listening)},
      local_{listening_.local()},
      table_{common.setup.clients_max, common.setup.idle},
      clients_(common.setup.clients_max)
{}

/// Returns the name of a client: its number, or its address if that is requested. By address, a
/// client that returns gets another name: "client.10.0.0.1:5000#2".
std::string Upstream::Part::name_of(const Client& client)
{
    constexpr std::size_t remembered_max = 65'536;
    const auto number = fmt::format("{}", client.number);
    if (!common_.setup.named_by_address) return client_path(number);
    const auto address = client.address->to_text();
    if (visits_.size() >= remembered_max && !visits_.contains(address)) {
        return client_path(fmt::format("{}#{}", address, number));
    }
    const auto visit = ++visits_[address];
    return client_path(visit == 1 ? address : fmt::format("{}#{}", address, visit));
}

void Upstream::Part::turn_away(const net::Received& datagram, const std::string& why)
{
    if (!notice_.permits(datagram.at)) return;
    untold_ = fmt::format("{} sends to --listen {}: dropped, {}", datagram.from.to_text(),
                          local_.to_text(), why);
}

/// Refuses a sender that may be a client but cannot be served.
void Upstream::Part::refuse(const net::Received& datagram, const std::string& why)
{
    ++refused_;
    turn_away(datagram, why);
}

/// Returns the client that sent the datagram, which may be a new one; null: the datagram is to be
/// dropped.
Upstream::Client* Upstream::Part::client_of(const net::Received& datagram)
{
    if (const auto known = table_.find(datagram.from, datagram.at)) return clients_[*known].get();
    if (common_.own.contains(datagram.from)) {
        ++strangers_;
        turn_away(datagram, "as it names the emulator's own address as its sender");
        return nullptr;
    }
    if (!common_.places.allowed.contains(datagram.from)) {
        ++strangers_;
        turn_away(datagram, "as --allow does not name it");
        return nullptr;
    }
    // Each part has places for all clients.
    const std::scoped_lock guard{common_.lock};
    if (common_.present >= common_.setup.clients_max) {
        refuse(datagram, fmt::format("as there are {} clients already: raise --clients, or lower "
                                     "--idle",
                                     common_.setup.clients_max));
        return nullptr;
    }
    const auto place = table_.add(datagram.from, datagram.at);
    base::ensure(place.has_value());
    clients_[*place] = admit(datagram, *place);
    if (!clients_[*place]) table_.forget(*place);
    return clients_[*place].get();
}

/// Returns a new client; null: the system refuses.
std::unique_ptr<Upstream::Client> Upstream::Part::admit(const net::Received& datagram,
                                                        std::size_t place)
{
    std::unique_ptr<Client> client;
    try {
        client = std::make_unique<Client>(++common_.numbered, datagram.from, common_.places);
        answers_.add(client->socket.descriptor(), place, {.to_read = true});
    } catch (const std::system_error& error) { // no descriptors or ports are left
        refuse(datagram, fmt::format("as the system has no socket for it: {}", error.what()));
        return nullptr;
    }
    ++common_.present;
    next_look_ = base::earlier(next_look_, table_.idle_at(place));
    client->name = name_of(*client);
    client->path = &paths_.add(client->name);
    put_by_number(by_path_, *client->path, client.get());
    client->recorded_as = add_to(common_.recorder, client->name, paths_.flows());
    common_.own.add(client->local);
    return client;
}

void Upstream::Part::take_from_clients()
{
    const auto arrived = listening_.receive();
    std::optional<Batch> undelayed; // for one client after the other
    const Client* whose = nullptr;
    for (const net::Received& datagram : arrived) {
        Client* client = client_of(datagram);
        if (client == nullptr) continue;
        if (whose != client) {
            if (undelayed) undelayed->flush();
            undelayed.emplace(way(*client, *client->path, Direction::up), to_server(*client));
            whose = client;
        }
        paths_.advance(datagram.at);
        undelayed->take(datagram, {CaptureSide::a, local_});
    }
    if (undelayed) undelayed->flush();
}

void Upstream::Part::take_from_server(Client& client)
{
    Batch undelayed{way(client, *client.path, Direction::down), to_client(client)};
    for (const net::Received& datagram : client.socket.receive()) {
        if (datagram.from != common_.places.server) {
            ++client.strangers;
            continue;
        }
        paths_.advance(datagram.at);
        undelayed.take(datagram, {CaptureSide::b, client.local});
    }
    undelayed.flush();
}

void Upstream::Part::receive()
{
    take_from_clients();
    for (const net::Ready& ready : answers_.ready()) {
        if (auto& client = clients_[ready.key]) take_from_server(*client);
    }
}

void Upstream::Part::release(base::TimePoint now)
{
    paths_.each_due(now, [&](std::size_t number) {
        Client& client = *by_path_[number];
        EmulatedPath& path = paths_.at(number);
        send_due(way(client, path, Direction::up), to_server(client),
                 way(client, path, Direction::down), to_client(client), now);
    });
    forget_idle(now);
}

namespace {

bool has_nothing_in_flight(const EmulatedPath& path)
{
    const auto is_idle = [](const EmulatedPath& one) {
        return one.link(Direction::up).statistics().in_flight +
                   one.link(Direction::down).statistics().in_flight ==
               0;
    };
    const Branches* branches = path.branches();
    return is_idle(path) && (branches == nullptr ||
                             std::ranges::all_of(branches->paths(), [&](const EmulatedPath* flow) {
                                 return is_idle(*flow);
                             }));
}

} // namespace

/// Forgets idle clients once their datagrams in flight are delivered. All clients are checked when
/// the first of them may be idle, not in each round. A client that has sent since then is not idle.
void Upstream::Part::forget_idle(base::TimePoint now)
{
    if (!base::is_due(next_look_, now)) return;
    constexpr base::Duration until_delivered = std::chrono::milliseconds{10};
    next_look_.reset();
    for (std::size_t place = 0; place < clients_.size(); ++place) {
        const auto& client = clients_[place];
        if (!client) continue;
        const auto idle_at = table_.idle_at(place);
        if (now >= idle_at && has_nothing_in_flight(*client->path)) {
            forget(place);
        } else {
            next_look_ = base::earlier(next_look_, std::max(idle_at, now + until_delivered));
        }
    }
}

void Upstream::Part::forget(std::size_t place)
{
    auto& client = clients_[place];
    departed_.up.add(client->path->link(Direction::up).statistics());
    departed_.down.add(client->path->link(Direction::down).statistics());
    if (const Branches* branches = client->path->branches()) {
        const auto flows = branches->paths();
        departed_.flows.resize(flows.size());
        for (std::size_t i = 0; i < flows.size(); ++i) {
            departed_.flows[i].up.add(flows[i]->link(Direction::up).statistics());
            departed_.flows[i].down.add(flows[i]->link(Direction::down).statistics());
        }
    }
    departed_.strangers_down += client->strangers;
    departed_.overflowed_down += client->socket.overflowed();
    departed_.unreachable_up += client->socket.unreachable();
    ++departed_.count;
    common_.own.remove(client->local);
    paths_.remove(client->name);
    client.reset();
    table_.forget(place);
    const std::scoped_lock guard{common_.lock};
    --common_.present;
}

std::optional<std::string> Upstream::Part::next_notice()
{
    return std::exchange(untold_, std::nullopt);
}

} // namespace hapnet::emulator::ports
