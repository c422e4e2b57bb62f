// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/inverse3/fake_service.hpp"

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <list>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <thread>

namespace hapnet::test {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using nlohmann::json;

constexpr const char* id = "049D";
constexpr double grip_n_per_m = 300.0; // of the hand that holds it
const glm::dvec3 middle{0.0, -0.15, 0.19};

json object_of(const glm::dvec3& it) { return {{"x", it.x}, {"y", it.y}, {"z", it.z}}; }

} // namespace

struct FakeInverseService::State {
    mutable std::mutex mutex; // protects all members that change
    std::condition_variable changed;
    std::array<bool, 7> fates{};
    bool is_stopping = false;
    int holder = -1; // the connection that commands the device
    glm::dvec3 place{middle};
    glm::dvec3 velocity{0.0};
    std::vector<glm::dvec3> forces;

    asio::io_context context;
    tcp::acceptor acceptor{context, {asio::ip::address_v4::loopback(), 0}};
    std::list<int> sockets;
    std::list<std::thread> threads;
    std::thread accepting;

    [[nodiscard]] bool is(Fate fate) const { return fates.at(static_cast<std::size_t>(fate)); }

    /// Returns a message about the device. Only the first message has the configuration.
    [[nodiscard]] std::string message(int connection, bool is_first) const
    {
        if (is(Fate::garbled) && !is_first) return R"({"inverse3":[{"device_id":)";
        json said{{"session_id", connection}, {"inverse3", json::array()}};
        if (!is(Fate::unplugged)) {
            json device{{"device_id", id},
                        {"state",
                         {{"cursor_position", object_of(place)},
                          {"cursor_velocity", object_of(velocity)},
                          {"control_mode", "idle"}}},
                        {"status",
                         {{"calibrated", is(Fate::calibrated)},
                          {"in_use", holder >= 0},
                          {"power_supply", !is(Fate::unpowered)},
                          {"ready", true},
                          {"started", true}}}};
            if (is_first) {
                const char* axes = is(Fate::permuted) ? "XZY" : "XYZ";
                device["config"] = {{"handedness", "right"}, {"basis", {{"permutation", axes}}}};
            }
            said["inverse3"].push_back(device);
        }
        said["wireless_verse_grip"] = json::array(
            {{{"device_id", "61576"}, {"state", {{"buttons", {{"a", is(Fate::pressed)}}}}}}});
        return said.dump();
    }

    void obey(const std::string& text, int connection)
    {
        const json told = json::parse(text);
        for (const json& device : told.at("inverse3")) {
            if (device.at("device_id") != id) continue;
            const json& vector = device.at("commands").at("set_cursor_force").at("vector");
            const glm::dvec3 force{vector.at("x").get<double>(), vector.at("y").get<double>(),
                                   vector.at("z").get<double>()};
            holder = connection;
            forces.push_back(force);
            const glm::dvec3 moved = 0.05 * (force / grip_n_per_m - (place - middle));
            place += moved;
            velocity = moved / 0.001;
        }
    }

    void serve(tcp::socket socket, int connection)
    {
        const int descriptor = socket.native_handle();
        beast::error_code error;
        beast::websocket::stream<tcp::socket> stream{std::move(socket)};
        stream.accept(error);
        std::unique_lock lock{mutex};
        for (bool is_first = true; !error && !is_stopping; is_first = false) {
            stream.write(asio::buffer(message(connection, is_first)), error);
            lock.unlock();
            beast::flat_buffer incoming;
            if (!error) stream.read(incoming, error);
            lock.lock();
            changed.wait(lock, [&] { return !is(Fate::mute) || is_stopping; });
            if (!error) obey(beast::buffers_to_string(incoming.data()), connection);
        }
        if (holder == connection) holder = -1;
        sockets.remove(descriptor);
    }

    void accept()
    {
        for (int connection = 1;; ++connection) {
            beast::error_code error;
            tcp::socket socket = acceptor.accept(error);
            const std::lock_guard lock{mutex};
            if (error || is_stopping) return;
            sockets.push_back(socket.native_handle());
            threads.emplace_back([this, connection, socket = std::move(socket)]() mutable {
                serve(std::move(socket), connection);
            });
        }
    }
};

FakeInverseService::FakeInverseService() : state_{std::make_unique<State>()}
{
    state_->accepting = std::thread{[this] { state_->accept(); }};
}

FakeInverseService::~FakeInverseService() { stop(); }

std::uint16_t FakeInverseService::port() const { return state_->acceptor.local_endpoint().port(); }

void FakeInverseService::set(Fate fate, bool on)
{
    const std::lock_guard lock{state_->mutex};
    state_->fates.at(static_cast<std::size_t>(fate)) = on;
    state_->changed.notify_all();
}

void FakeInverseService::stop()
{
    if (!state_->accepting.joinable()) return;
    {
        const std::lock_guard lock{state_->mutex};
        state_->is_stopping = true;
        for (const int socket : state_->sockets) ::shutdown(socket, SHUT_RDWR);
        ::shutdown(state_->acceptor.native_handle(), SHUT_RDWR);
        state_->changed.notify_all();
    }
    state_->accepting.join();
    for (std::thread& thread : state_->threads) thread.join();
    state_->threads.clear();
    beast::error_code ignored;
    state_->acceptor.close(ignored);
}

std::vector<glm::dvec3> FakeInverseService::forces() const
{
    const std::lock_guard lock{state_->mutex};
    return state_->forces;
}

} // namespace hapnet::test
