// Wakes one thread that sleeps in poll() from any other thread (Linux eventfd).
#pragma once

namespace headrace::server {

class Doorbell {
  public:
    Doorbell();
    ~Doorbell();
    Doorbell(const Doorbell&) = delete;
    Doorbell& operator=(const Doorbell&) = delete;

    void ring() noexcept;   // any thread
    void quiet() noexcept;  // owner: takes back all rings so far
    int fd() const { return fd_; }

  private:
    int fd_;
};

}  // namespace headrace::server
