// Thumbnails in KDE's file managers: KIO loads this plugin, which calls the program as burnish.thumbnailer does.
#include <KIO/ThumbnailCreator>
#include <KPluginFactory>
#include <QImage>
#include <QProcess>

class BurnishThumbnail : public KIO::ThumbnailCreator {
    Q_OBJECT
public:
    using KIO::ThumbnailCreator::ThumbnailCreator;

    KIO::ThumbnailResult create(const KIO::ThumbnailRequest &request) override {
        const QSize size = request.targetSize();
        const QString pixels = QStringLiteral("--size=%1").arg(qMax(16, qMin(size.width(), size.height())));
        QProcess burnish;
        burnish.start(QStringLiteral("burnish"),
                      {QStringLiteral("render"), QStringLiteral("--sandbox"), QStringLiteral("--quiet"),
                       QStringLiteral("--no-background"), pixels, QStringLiteral("--max-seconds=15"),
                       QStringLiteral("--max-memory=4G"), QStringLiteral("--max-input-bytes=1G"),
                       QStringLiteral("--output-format=png"), QStringLiteral("--output=-"), QStringLiteral("--"),
                       request.url().toLocalFile()});
        if (!burnish.waitForFinished(160000) || burnish.exitCode() != 0) { // --max-seconds in wall time is ten times that
            return KIO::ThumbnailResult::fail();
        }
        const QImage image = QImage::fromData(burnish.readAllStandardOutput(), "PNG");
        return image.isNull() ? KIO::ThumbnailResult::fail() : KIO::ThumbnailResult::pass(image);
    }
};

K_PLUGIN_CLASS_WITH_JSON(BurnishThumbnail, "burnishthumbnail.json")

#include "burnishthumbnail.moc"
