<?php
namespace OCA\Burnish;

use OCP\Files\{File, FileInfo};
use OCP\{IImage, Image};
use OCP\Preview\IProviderV2;

/** The file goes through a pipe, so storage can be remote or encrypted. */
class Preview implements IProviderV2 {
    public const TYPES = '/^model\/.*/';

    public function getMimeType(): string {
        return self::TYPES;
    }

    public function isAvailable(FileInfo $file): bool {
        return $file->getSize() > 0;
    }

    public function getThumbnail(File $file, int $maxX, int $maxY): ?IImage {
        $command = ['burnish', 'render', '-', '--input-format=' . strtolower(pathinfo($file->getName(), PATHINFO_EXTENSION)),
            '--sandbox', '--quiet', '--no-background', '--size=' . max(16, min($maxX, $maxY, 1024)),
            '--max-seconds=15', '--max-memory=4G', '--output-format=png', '--output=-'];
        $burnish = proc_open($command, [['pipe', 'r'], ['pipe', 'w'], ['file', '/dev/null', 'w']], $pipes);
        if (!$burnish) {
            return null;
        }
        stream_copy_to_stream($file->fopen('r'), $pipes[0]);
        fclose($pipes[0]);
        $png = stream_get_contents($pipes[1]);
        $image = new Image();
        return proc_close($burnish) === 0 && $image->loadFromData($png) ? $image : null;
    }
}
