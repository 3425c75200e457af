<?php
namespace OCA\Burnish\AppInfo;

use OCA\Burnish\Preview;
use OCP\AppFramework\App;
use OCP\AppFramework\Bootstrap\{IBootContext, IBootstrap, IRegistrationContext};

class Application extends App implements IBootstrap {
    public function __construct() {
        parent::__construct('burnish');
    }

    public function register(IRegistrationContext $context): void {
        $context->registerPreviewProvider(Preview::class, Preview::TYPES);
    }

    public function boot(IBootContext $context): void {
    }
}
