#pragma once
// A small HTTP/1.1 server for one folder, on 127.0.0.1 only (RFC 9110, RFC 9112): GET and HEAD,
// ranges, and nothing else.

#include <atomic>
#include <cstdint>
#include <functional>

#include "cli/served_folder.h"

namespace ringcraft {

struct HttpLimits {
  std::uint32_t header_bytes = 16 * 1024;
  std::size_t connections = 64;       // at once; further ones are closed
  double request_s = 10;              // to send a whole request, and to be idle between two
  double chunk_s = 30;                // to take 64 KiB of an answer
  std::atomic<bool>* stop = nullptr;  // ends the server when true; SIGINT and SIGTERM set it
};

// Serves until SIGINT or SIGTERM. `ready` is told the port once connections are taken. Fails where
// the port cannot be had.
Result<void> serve_http(const ServedFolder& folder, std::uint16_t port, const HttpLimits& limits,
                        const std::function<void(std::uint16_t)>& ready);

}  // namespace ringcraft
