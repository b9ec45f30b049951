// SPDX-License-Identifier: GPL-2.0-only

// Replaces libFuzzer: replays a corpus, each input also truncated, spliced and with bytes changed,
// and then random bytes. The inputs are the same in every run.
//
//   replay_NAME COUNT CORPUS_FOLDER

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace {

void feed(const std::string &input)
{
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(input.data()), input.size());
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s COUNT CORPUS_FOLDER\n", argv[0]);
    return 2;
  }
  const long count = std::atol(argv[1]);
  std::vector<std::filesystem::path> paths;
  for (const auto &entry : std::filesystem::directory_iterator(argv[2]))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> corpus;
  for (const auto &path : paths) {
    std::ifstream file(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    feed(corpus.back());
  }
  if (corpus.empty()) {
    std::fprintf(stderr, "%s holds no inputs\n", argv[2]);
    return 2;
  }

  std::mt19937_64 random(20250204);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (long i = 0; i < count; ++i) {
    std::string input;
    if (i % 2 == 0) {
      input.resize(below(400));
      for (char &c : input) c = static_cast<char>(random());
    } else {
      const std::string &one = corpus[below(corpus.size())];
      const std::string &other = corpus[below(corpus.size())];
      input = one.substr(0, below(one.size() + 1)) + other.substr(below(other.size() + 1));
      for (std::size_t change = below(4); change > 0 && !input.empty(); --change)
        input[below(input.size())] = static_cast<char>(random());
    }
    feed(input);
  }
  std::printf("%zu corpus inputs and %ld others: no violation\n", corpus.size(), count);
  return 0;
}
