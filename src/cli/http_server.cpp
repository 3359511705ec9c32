#include "cli/http_server.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

namespace ringcraft {

namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using tcp = net::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kChunk = std::size_t{64} * 1024;
constexpr double kPause_s = 0.1;  // after a connection that could not be taken
constexpr double kSwallow_s = 2;  // for which is read on after a refusal
constexpr std::uint64_t kSwallowed = std::uint64_t{1} << 20;  // and how many bytes at most

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

using Request = http::request<http::empty_body>;
using Head = http::response<http::empty_body>;

// What is sent for a request: the head, then text or a part of a file.
struct Answer {
  Head head;
  std::string text;
  OpenFile file;
  std::uint64_t next = 0, left = 0;  // of the file
  bool close = false;
};

void set_common(Answer& answer, http::status status, std::string_view type) {
  Head& head = answer.head;
  head.version(11);
  head.result(status);
  head.set(http::field::server, "ringcraft");
  head.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  head.set(http::field::cache_control, "no-cache");
  head.set("X-Content-Type-Options", "nosniff");
  head.set("Cross-Origin-Resource-Policy", "same-origin");
}

// A short text; the connection ends where `close`.
Answer plain_answer(http::status status, const std::string& text, bool close) {
  Answer answer;
  set_common(answer, status, "text/plain; charset=utf-8");
  answer.text = text + "\n";
  answer.head.content_length(answer.text.size());
  answer.close = close;
  return answer;
}

// Only this machine's own names, or a page elsewhere could be led here by its name server.
bool is_own_host(beast::string_view host, std::uint16_t port) {
  const std::string_view given(host.data(), host.size());
  for (const std::string_view name : {"127.0.0.1", "localhost"}) {
    if (given == fmt::format("{}:{}", name, port) || (port == 80 && given == name)) return true;
  }
  return false;
}

Answer file_answer(Served&& served, const Request& request) {
  Answer answer;
  const std::uint64_t size = served.file.size();
  RangeAnswer asked;
  const auto range = request[http::field::range];
  // A file has no tag here, so a condition on one never holds.
  if (!range.empty() && request[http::field::if_range].empty())
    asked = range_answer({range.data(), range.size()}, size);
  if (asked.kind == RangeAnswer::Kind::outside) {
    Answer told = plain_answer(http::status::range_not_satisfiable, "beyond the end", false);
    told.head.set(http::field::content_range, fmt::format("bytes */{}", size));
    return told;
  }
  const bool part = asked.kind == RangeAnswer::Kind::part;
  set_common(answer, part ? http::status::partial_content : http::status::ok, served.type);
  answer.head.set(http::field::accept_ranges, "bytes");
  answer.next = part ? asked.range.first : 0;
  answer.left = part ? asked.range.last - asked.range.first + 1 : size;
  if (part)
    answer.head.set(http::field::content_range,
                    fmt::format("bytes {}-{}/{}", asked.range.first, asked.range.last, size));
  answer.head.content_length(answer.left);
  answer.file = std::move(served.file);
  return answer;
}

Answer answer_to(const ServedFolder& folder, const Request& request, std::uint16_t port) {
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    Answer answer = plain_answer(http::status::method_not_allowed, "only GET and HEAD", true);
    answer.head.set(http::field::allow, "GET, HEAD");
    return answer;
  }
  if (request.count(http::field::transfer_encoding) > 0 ||
      (request.has_content_length() && request[http::field::content_length] != "0"))
    return plain_answer(http::status::bad_request, "a GET has no body", true);
  if (!is_own_host(request[http::field::host], port))
    return plain_answer(http::status::misdirected_request, "another host's name", true);
  const auto target = request.target();
  Served served = folder.find({target.data(), target.size()});
  switch (served.kind) {
    case Served::Kind::refused:
      return plain_answer(http::status::forbidden, "not in this folder", false);
    case Served::Kind::moved: {
      Answer answer = plain_answer(http::status::moved_permanently, served.text, false);
      answer.head.set(http::field::location, served.text);
      return answer;
    }
    case Served::Kind::page: {
      Answer answer;
      set_common(answer, http::status::ok, served.type);
      answer.head.set("Content-Security-Policy",
                      "default-src 'none'; style-src 'unsafe-inline'; img-src data:");
      answer.text = std::move(served.text);
      answer.head.content_length(answer.text.size());
      return answer;
    }
    case Served::Kind::file:
      return file_answer(std::move(served), request);
    case Served::Kind::nothing:
      break;
  }
  return plain_answer(http::status::not_found, "no such file", false);
}

// What a request that is not HTTP, or too much of it, is told.
std::optional<Answer> answer_to_fault(error_code fault) {
  if (fault == http::error::header_limit || fault == http::error::buffer_overflow)
    return plain_answer(http::status::request_header_fields_too_large, "too long a header", true);
  // Every other fault of the parser; the rest is the connection's.
  if (fault.category() == http::make_error_code(http::error::bad_method).category() &&
      fault != http::error::end_of_stream && fault != http::error::partial_message)
    return plain_answer(http::status::bad_request, "not understood", true);
  return std::nullopt;
}

struct Shared {
  const ServedFolder& folder;
  const HttpLimits& limits;
  std::uint16_t port = 0;
  std::size_t connections = 0;
};

// One connection: a request, its answer, the next request.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket&& socket, Shared& shared)
      : stream_(std::move(socket)), buffer_(shared.limits.header_bytes + 1024), shared_(shared) {
    ++shared_.connections;
  }
  ~Session() { --shared_.connections; }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(shared_.limits.header_bytes);
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());  // none is read
    stream_.expires_after(milliseconds(shared_.limits.request_s));
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](error_code fault, std::size_t) { self->on_read(fault); });
  }

 private:
  void on_read(error_code fault) {
    if (fault) {
      if (auto told = answer_to_fault(fault)) send(std::move(*told), false);
      return;
    }
    const Request& request = parser_->get();
    Answer answer = answer_to(shared_.folder, request, shared_.port);
    answer.close |= !request.keep_alive();
    send(std::move(answer), request.method() == http::verb::head);
  }

  void send(Answer&& answer, bool head_only) {
    answer_.emplace(std::move(answer));
    answer_->head.keep_alive(!answer_->close);
    if (head_only) answer_->text.clear(), answer_->left = 0;
    serializer_.emplace(answer_->head);
    stream_.expires_after(milliseconds(shared_.limits.chunk_s));
    http::async_write_header(stream_, *serializer_,
                             [self = shared_from_this()](error_code fault, std::size_t) {
                               if (fault) return;
                               self->send_body();
                             });
  }

  void send_body() {
    if (!answer_->text.empty()) {
      write(net::buffer(answer_->text), true);
    } else if (answer_->left > 0) {
      const std::size_t wanted =
          static_cast<std::size_t>(std::min<std::uint64_t>(kChunk, answer_->left));
      const std::size_t got = answer_->file.read(answer_->next, chunk_.data(), wanted);
      if (got == 0) return;  // the file became shorter: the connection ends, and the client sees it
      answer_->next += got;
      answer_->left -= got;
      write(net::buffer(chunk_.data(), got), answer_->left == 0);
    } else {
      finish();
    }
  }

  void write(net::const_buffer bytes, bool last) {
    stream_.expires_after(milliseconds(shared_.limits.chunk_s));
    net::async_write(stream_, bytes,
                     [self = shared_from_this(), last](error_code fault, std::size_t) {
                       if (fault) return;
                       last ? self->finish() : self->send_body();
                     });
  }

  void finish() {
    answer_->file = OpenFile();
    if (!answer_->close) return read();
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(milliseconds(kSwallow_s));
    swallow();
  }

  // Reads what a refused client still sends, for a while, or it would never see the answer.
  void swallow() {
    stream_.async_read_some(net::buffer(chunk_),
                            [self = shared_from_this()](error_code fault, std::size_t got) {
                              self->swallowed_ += got;
                              if (!fault && self->swallowed_ < kSwallowed) self->swallow();
                            });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  Shared& shared_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::response_serializer<http::empty_body>> serializer_;
  std::optional<Answer> answer_;
  std::array<char, kChunk> chunk_{};
  std::uint64_t swallowed_ = 0;
};

class Listener {
 public:
  Listener(net::io_context& context, Shared& shared)
      : acceptor_(context), pause_(context), shared_(shared) {}

  error_code open(std::uint16_t port) {
    error_code fault;
    const tcp::endpoint endpoint(net::ip::address_v4::loopback(), port);
    acceptor_.open(endpoint.protocol(), fault);
    if (!fault) acceptor_.set_option(net::socket_base::reuse_address(true), fault);
    if (!fault) acceptor_.bind(endpoint, fault);
    if (!fault) acceptor_.listen(net::socket_base::max_listen_connections, fault);
    if (!fault) shared_.port = acceptor_.local_endpoint(fault).port();
    return fault;
  }

  void accept() {
    acceptor_.async_accept([this](error_code fault, tcp::socket socket) {
      if (fault == net::error::operation_aborted) return;
      if (!fault && shared_.connections < shared_.limits.connections)
        std::make_shared<Session>(std::move(socket), shared_)->read();
      if (!fault) return accept();
      // No descriptors are left, say: others end meanwhile.
      pause_.expires_after(milliseconds(kPause_s));
      pause_.async_wait([this](error_code stopped) {
        if (!stopped) accept();
      });
    });
  }

 private:
  tcp::acceptor acceptor_;
  net::steady_timer pause_;
  Shared& shared_;
};

}  // namespace

Result<void> serve_http(const ServedFolder& folder, std::uint16_t port, const HttpLimits& limits,
                        const std::function<void(std::uint16_t)>& ready) {
  Shared shared{folder, limits};
  net::io_context context(1);
  Listener listener(context, shared);
  if (const error_code fault = listener.open(port)) {
    return usage_error("", "", fmt::format("port {} of 127.0.0.1: {}", port, fault.message()),
                       "choose another with --port, or 0 for any that is free");
  }
  net::signal_set signals(context, SIGINT, SIGTERM);
  signals.async_wait([&](error_code fault, int) {
    if (fault) return;
    *limits.stop = true;
    context.stop();
  });
  if (*limits.stop) return {};
  listener.accept();
  ready(shared.port);
  context.run();
  return {};
}

}  // namespace ringcraft
