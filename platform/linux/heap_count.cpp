// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/heap_count.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NEONTETRA_HEAP_COUNT 1
#endif

namespace nt {
namespace {

thread_local bool counting = false;
thread_local int64_t allocations_on_thread = 0;

}  // namespace

#ifdef NEONTETRA_HEAP_COUNT
inline void count_allocation() {
  if (counting) ++allocations_on_thread;
}
bool heap_count_available() { return true; }
#else
bool heap_count_available() { return false; }
#endif

HeapCount::HeapCount() {
  allocations_on_thread = 0;
  counting = true;
}
HeapCount::~HeapCount() { counting = false; }
int64_t HeapCount::allocations() const { return allocations_on_thread; }

}  // namespace nt

#ifdef NEONTETRA_HEAP_COUNT
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  nt::count_allocation();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  nt::count_allocation();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  nt::count_allocation();
  return __libc_realloc(old, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  nt::count_allocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  nt::count_allocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  nt::count_allocation();
  void* block = __libc_memalign(alignment, size);
  if (block == nullptr) return ENOMEM;
  *out = block;
  return 0;
}

}  // extern "C"
#endif
