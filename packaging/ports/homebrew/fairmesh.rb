# For a tap: the library and the command line as they are published. Homebrew's own formulas build from sources.
class Fairmesh < Formula
  desc "Fair surfaces on triangle meshes: fills holes, removes bumps and dents"
  homepage "@REPOSITORY@"
  version "@VERSION@"
  license any_of: ["MIT", "Apache-2.0"]

  on_macos do
    on_arm do
      url "@URL@/fairmesh-@VERSION@-macos-aarch64.tar.gz"
      sha256 "@SHA256:macos-aarch64.tar.gz@"

      resource "cli" do
        url "@URL@/fairmesh-cli-@VERSION@-macos-aarch64.tar.gz"
        sha256 "@SHA256:cli:macos-aarch64.tar.gz@"
      end
    end
    on_intel do
      url "@URL@/fairmesh-@VERSION@-macos-x86_64.tar.gz"
      sha256 "@SHA256:macos-x86_64.tar.gz@"

      resource "cli" do
        url "@URL@/fairmesh-cli-@VERSION@-macos-x86_64.tar.gz"
        sha256 "@SHA256:cli:macos-x86_64.tar.gz@"
      end
    end
  end
  on_linux do
    on_arm do
      url "@URL@/fairmesh-@VERSION@-linux-aarch64.tar.gz"
      sha256 "@SHA256:linux-aarch64.tar.gz@"

      resource "cli" do
        url "@URL@/fairmesh-cli-@VERSION@-linux-aarch64.tar.gz"
        sha256 "@SHA256:cli:linux-aarch64.tar.gz@"
      end
    end
    on_intel do
      url "@URL@/fairmesh-@VERSION@-linux-x86_64.tar.gz"
      sha256 "@SHA256:linux-x86_64.tar.gz@"

      resource "cli" do
        url "@URL@/fairmesh-cli-@VERSION@-linux-x86_64.tar.gz"
        sha256 "@SHA256:cli:linux-x86_64.tar.gz@"
      end
    end
  end

  def install
    prefix.install "include", "lib", "share"
    resource("cli").stage do
      bin.install "fairmesh"
      man1.install Dir["man/man1/*"]
      bash_completion.install "completions/fairmesh.bash" => "fairmesh"
      zsh_completion.install "completions/_fairmesh"
      fish_completion.install "completions/fairmesh.fish"
    end
  end

  test do
    assert_match version.to_s, shell_output("#{bin}/fairmesh --version")
    (testpath/"test.c").write <<~C
      #include <fairmesh.h>
      int main(void) { return fairmesh_version() ? 0 : 1; }
    C
    system ENV.cc, "test.c", "-I#{include}", "-L#{lib}", "-lfairmesh", "-Wl,-rpath,#{lib}", "-o", "test"
    system "./test"
  end
end
