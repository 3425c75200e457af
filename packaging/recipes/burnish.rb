# Homebrew. `make dist` fills in what is between @, of the sources on the release's page.
class Burnish < Formula
  desc "Meshes drawn on the CPU, the same pixels on every machine"
  homepage "@ADDRESS@"
  url "@ADDRESS@/releases/download/v@VERSION@/burnish-@VERSION@.tar.gz"
  sha256 "@SHA256@"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "xxhash" => :build
  depends_on "cjson"
  depends_on "isa-l"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "webp"
  depends_on "zstd"
  uses_from_macos "expat"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DBURNISH_TESTS=OFF", "-DBURNISH_PYTHON=OFF", "-DBURNISH_EXR=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"burnish", "render", ":teapot", "-o", "teapot.png"
    assert_match version.to_s, shell_output("#{bin}/burnish --version")
  end
end
